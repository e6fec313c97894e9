# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Builds under build/<name>, and knows where what was built lies.

source "$PANVO_SCRIPTS/lib/packages.sh"

# cmake_arguments NAME: how each kind of build is configured; the same as the presets of CMakePresets.json.
cmake_arguments() {
  case $1 in
    release) echo -DCMAKE_BUILD_TYPE=Release ;;
    debug) echo -DCMAKE_BUILD_TYPE=Debug -DPANVO_UNITY=OFF ;;
    asan) echo -DCMAKE_BUILD_TYPE=RelWithDebInfo -DPANVO_SANITIZE=address ;;
    ubsan) echo -DCMAKE_BUILD_TYPE=RelWithDebInfo -DPANVO_SANITIZE=undefined ;;
    tsan) echo -DCMAKE_BUILD_TYPE=RelWithDebInfo -DPANVO_SANITIZE=thread ;;
    *) fail "there is no build called '$1'; there are release, debug, asan, ubsan and tsan" 2 ;;
  esac
}

# sanitizer_build NAME: the build for `--sanitize NAME`.
sanitizer_build() {
  case $1 in
    address | asan) echo asan ;;
    undefined | ubsan) echo ubsan ;;
    thread | tsan) echo tsan ;;
    *) fail "there is no sanitizer '$1'; there are address, undefined and thread" 2 ;;
  esac
}

build_folder() { printf '%s/build/%s' "$PANVO_HOME" "$PANVO_BUILD"; }

# job_count: cores, but no more than memory carries (the largest sources take about 1.2 GB each to compile).
job_count() {
  local cores carried
  cores=${PANVO_JOBS:-$(nproc)}
  [[ $cores =~ ^[1-9][0-9]*$ ]] || fail "PANVO_JOBS is '$cores'; it takes a number from 1"
  carried=$(awk '/^MemAvailable/ { print int($2 / 1200000) }' /proc/meminfo 2>/dev/null || echo "$cores")
  [[ -n ${PANVO_JOBS:-} ]] || { ((carried >= cores)) || cores=$((carried > 1 ? carried : 1)); }
  printf '%s' "$cores"
}

# build_targets TARGET...: configures when needed, then builds. Prints nothing when everything is up to date.
build_targets() {
  local folder configuration stamp
  folder=$(build_folder)
  configuration=$(cmake_arguments "$PANVO_BUILD")
  if ! { mkdir -p "$folder" && touch "$PANVO_HOME/build/COLCON_IGNORE" "$folder/.panvo_lock"; } 2>/dev/null; then
    fail "$folder cannot be written to: build as its owner, or in a copy of the checkout. What is built there already runs: panvo run, evaluate and others"
  fi
  # Two panvo at once take turns: ninja itself does not guard its folder.
  exec {lock}>"$folder/.panvo_lock"
  flock -n "$lock" || { note "waiting for another build of build/$PANVO_BUILD"; flock "$lock"; }

  # The stamp is what this tree was configured from; another checkout or other arguments mean configuring anew.
  stamp="$PANVO_HOME $configuration"
  if [[ ! -f $folder/build.ninja || $(cat "$folder/.panvo_configured" 2>/dev/null) != "$stamp" ]]; then
    note "configuring build/$PANVO_BUILD"
    rm -f "$folder/.panvo_configured"
    # shellcheck disable=SC2086  # a list of arguments without blanks
    cmake -S "$PANVO_HOME" -B "$folder" -G Ninja $configuration >"$folder/configure.log" 2>&1 || {
      tail -n 30 "$folder/configure.log" >&2
      fail "configuring failed; the whole log is $folder/configure.log"
    }
    printf '%s\n' "$stamp" >"$folder/.panvo_configured"
  fi

  # Sources that change from now on are newer than what is built.
  touch "$folder/.panvo_building"
  NINJA_STATUS='[%f/%t, %es] ' ninja -C "$folder" -j "$(job_count)" "$@" 2>&1 | show_build_progress ||
    fail "the build failed; the messages above say where. Once more, one job at a time: ninja -C $folder -j 1"
  [[ " $* " != *" all "* && " $* " != *" panvo_programs "* ]] || mv "$folder/.panvo_building" "$folder/.panvo_built"
  exec {lock}>&-
}

# Nothing when there is nothing to do; one line that moves on a terminal, in a log file one for every twentieth part. What is no
# progress (warnings, errors) is kept whole.
show_build_progress() {
  local line step shown=0 moving=no begun=no edge='^\[([0-9]+)/([0-9]+), '
  # Not awk: Debian's smallest one waits for a whole block of input before it looks at the first line.
  while IFS= read -r line; do
    case $line in
      'ninja: Entering directory'* | 'ninja: no work to do.' | *'Re-checking globbed directories'* | *'Re-running CMake'* | '-- '*) continue ;;
    esac
    if [[ $line =~ $edge ]]; then
      [[ $begun == yes ]] || note "building build/$PANVO_BUILD: ${BASH_REMATCH[2]} steps"
      begun=yes
      step=$((20 * BASH_REMATCH[1] / BASH_REMATCH[2]))
      if is_terminal; then
        printf '\r\033[K%s' "${line:0:110}" >&2
        moving=yes
      elif ((step > shown)); then
        printf '%s\n' "$line" >&2
      fi
      ((step <= shown)) || shown=$step
    else
      [[ $moving == no ]] || printf '\r\033[K' >&2
      moving=no
      printf '%s\n' "$line" >&2
    fi
  done
  [[ $moving == no ]] || printf '\r\033[K' >&2
}

# use_built PROGRAM...: for the verbs that run what is there, be it of another user, on a read-only disk, or while a build is under way. They build
# nothing; what is missing is said, with the command that makes it.
use_built() {
  in_checkout || return 0
  local folder name newer
  folder=$(build_folder)
  for name in "$@"; do
    [[ -x $folder/panvo_bin/$name ]] || fail "$name is not built; 'panvo build' builds everything$(is_build_running "$folder" && echo ' (a build is under way: wait for it)')"
  done
  if is_build_running "$folder"; then
    note "build/$PANVO_BUILD is being built; going on with what is there"
  elif newer=$(newer_source "$folder") && [[ -n $newer ]]; then
    note "$newer is newer than build/$PANVO_BUILD; 'panvo build' brings it up to date"
  fi
}

# is_build_running FOLDER: whether another panvo builds in it.
is_build_running() {
  local lock
  [[ -r $1/.panvo_lock ]] || return 1
  exec {lock}<"$1/.panvo_lock"
  if flock -n "$lock"; then
    exec {lock}<&-
    return 1
  fi
  exec {lock}<&-
}

# newer_source FOLDER: a source that was changed after FOLDER was built, or nothing.
newer_source() {
  [[ -f $1/.panvo_built ]] || return 0
  find "$PANVO_HOME"/{interfaces,components,drivers} -newer "$1/.panvo_built" \( -name '*.cpp' -o -name '*.hpp' -o -name CMakeLists.txt \) \
    -not -path '*/test/*' -printf '%P\n' -quit 2>/dev/null || true
}

# ensure_built TARGET...: what a verb that compiles needs before it can do its work; nothing to do once installed.
ensure_built() {
  in_checkout || return 0
  ensure_packages build
  build_targets "$@"
}

# program NAME: path of one of our executables, built or installed.
program() {
  local candidate
  if in_checkout; then
    candidate=$(build_folder)/panvo_bin/$1
  else
    candidate=$(readlink -m -- "$PANVO_HOME/../../bin/$1")
    [[ -x $candidate ]] || candidate=$(command -v "$1" || true)
  fi
  [[ -n $candidate && -x $candidate ]] || fail "$1 is not there; $(in_checkout && echo "'panvo build' makes it" || echo "source the setup.bash of the installed workspace, or install panvo anew")"
  printf '%s' "$candidate"
}

# use_plugins: programs started from here find the components, and a user's own ones first.
use_plugins() {
  in_checkout || return 0
  local folder
  folder=$(build_folder)
  export PANVO_PLUGIN_PATH="${PANVO_PLUGIN_PATH:+$PANVO_PLUGIN_PATH:}$folder/panvo_plugins"
  export PATH="$folder/panvo_bin:$PATH"
}

# start_program NAME ARGUMENT...: the verb becomes the program.
start_program() {
  local name=$1 path
  shift
  use_built "$name"
  use_plugins
  path=$(program "$name")
  exec "$path" "$@"
}

# show_program_help NAME: the program's own words where it is built; --help never starts a build.
show_program_help() {
  local path
  path=$(program "$1" 2>/dev/null) || {
    printf '\n("panvo build" first, then this shows all options.)\n'
    return 0
  }
  printf '\n'
  use_plugins
  "$path" --help
}
