# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Builds into build/<name> and locates the built programs and plugins.

source "$PANVO_SCRIPTS/lib/packages.sh"
source "$PANVO_SCRIPTS/lib/arm64.sh"

# cmake_arguments NAME: CMake arguments of a build type, as the presets in CMakePresets.json; with $CI, warnings of release and arm64 are errors.
cmake_arguments() {
  case $1 in
    release) echo "-DCMAKE_BUILD_TYPE=Release -DPANVO_WARNINGS_AS_ERRORS=$([[ -n ${CI:-} ]] && echo ON || echo OFF)" ;;
    debug) echo -DCMAKE_BUILD_TYPE=Debug -DPANVO_UNITY=OFF -DPANVO_PRECOMPILED_HEADERS=OFF ;;
    asan) echo -DCMAKE_BUILD_TYPE=RelWithDebInfo -DPANVO_SANITIZE=address ;;
    ubsan) echo -DCMAKE_BUILD_TYPE=RelWithDebInfo -DPANVO_SANITIZE=undefined ;;
    tsan) echo -DCMAKE_BUILD_TYPE=RelWithDebInfo -DPANVO_SANITIZE=thread ;;
    clang) echo -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=clang++ ;;
    fuzz) echo -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_COMPILER=clang++ -DPANVO_FUZZ=ON ;;
    arm64) echo "-DCMAKE_BUILD_TYPE=Release -DCMAKE_TOOLCHAIN_FILE=config/build/arm64.cmake -DPANVO_WARNINGS_AS_ERRORS=$([[ -n ${CI:-} ]] && echo ON || echo OFF)" ;;
    package) echo -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF -DCMAKE_INSTALL_PREFIX=/usr -DCMAKE_SKIP_INSTALL_RPATH=ON ;;
    *) fail "unknown build type '$1'; use release, debug, asan, ubsan, tsan, clang, fuzz, arm64 or package" 2 ;;
  esac
}

# sanitizer_build NAME: build type of `--sanitize NAME`.
sanitizer_build() {
  case $1 in
    address | asan) echo asan ;;
    undefined | ubsan) echo ubsan ;;
    thread | tsan) echo tsan ;;
    *) fail "unknown sanitizer '$1'; use address, undefined or thread" 2 ;;
  esac
}

build_folder() { printf '%s/build/%s' "$PANVO_HOME" "$PANVO_BUILD"; }

# job_count: number of cores, limited by the available memory (the largest sources need about 1.2 GB each to compile).
job_count() {
  local cores carried
  cores=${PANVO_JOBS:-$(nproc)}
  [[ $cores =~ ^[1-9][0-9]*$ ]] || fail "PANVO_JOBS is '$cores'; it must be an integer of at least 1"
  carried=$(awk '/^MemAvailable/ { print int($2 / 1200000) }' /proc/meminfo 2>/dev/null || echo "$cores")
  [[ -n ${PANVO_JOBS:-} ]] || { ((carried >= cores)) || cores=$((carried > 1 ? carried : 1)); }
  printf '%s' "$cores"
}

# build_targets TARGET...: configures if needed, then builds. Prints nothing if everything is up to date.
build_targets() {
  local folder configuration stamp
  folder=$(build_folder)
  configuration=$(cmake_arguments "$PANVO_BUILD")
  if ! { mkdir -p "$folder" && touch "$PANVO_HOME/build/COLCON_IGNORE" "$folder/.panvo_lock"; } 2>/dev/null; then
    fail "$folder is not writable: build as its owner, or in a copy of the checkout. Programs built there can be used: panvo run, evaluate and others"
  fi
  # Serialises concurrent builds: ninja does not lock its folder.
  exec {lock}>"$folder/.panvo_lock"
  flock -n "$lock" || { note "waiting for another build of build/$PANVO_BUILD"; flock "$lock"; }

  # The stamp holds the checkout and the arguments of the last configuration; if either changes, configure again.
  stamp="$PANVO_HOME $configuration"
  if [[ ! -f $folder/build.ninja || $(cat "$folder/.panvo_configured" 2>/dev/null) != "$stamp" ]]; then
    note "configuring build/$PANVO_BUILD"
    rm -f "$folder/.panvo_configured"
    # shellcheck disable=SC2086  # a list of arguments without spaces
    cmake -S "$PANVO_HOME" -B "$folder" -G Ninja $configuration >"$folder/configure.log" 2>&1 || {
      tail -n 30 "$folder/configure.log" >&2
      fail "configuring failed; full log: $folder/configure.log"
    }
    printf '%s\n' "$stamp" >"$folder/.panvo_configured"
  fi

  # newer_source compares with the time at which the build started.
  touch "$folder/.panvo_building"
  NINJA_STATUS='[%f/%t, %es] ' ninja -C "$folder" -j "$(job_count)" "$@" 2>&1 | show_build_progress ||
    fail "the build failed, see the messages above. To retry with one job: ninja -C $folder -j 1"
  [[ " $* " != *" all "* && " $* " != *" panvo_programs "* ]] || mv "$folder/.panvo_building" "$folder/.panvo_built"
  exec {lock}>&-
}

# Shows ninja's progress: one updated line on a terminal, else a line per 5 %. Nothing if there is nothing to do. Warnings and
# errors are printed in full.
show_build_progress() {
  local line step shown=0 moving=no begun=no edge='^\[([0-9]+)/([0-9]+), '
  # Not awk: mawk, Debian's default, waits for a full block of input before it reads the first line.
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

# use_built PROGRAM...: for commands that only run programs. Builds nothing, so it also works in another user's checkout, on a read-only disk, or
# during a build. Fails if a program is missing, and notes if the build is older than the sources.
use_built() {
  in_checkout || return 0
  local folder name newer
  folder=$(build_folder)
  for name in "$@"; do
    [[ -x $folder/panvo_bin/$name ]] || fail "$name is not built; 'panvo build' builds everything$(is_build_running "$folder" && echo ' (a build is running: wait for it)')"
  done
  if is_build_running "$folder"; then
    note "build/$PANVO_BUILD is being built; using the existing programs"
  elif newer=$(newer_source "$folder") && [[ -n $newer ]]; then
    note "$newer is newer than build/$PANVO_BUILD; run 'panvo build' to update"
  fi
}

# is_build_running FOLDER: whether another process is building there.
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

# newer_source FOLDER: prints one source that is newer than the build in FOLDER, or nothing.
newer_source() {
  [[ -f $1/.panvo_built ]] || return 0
  find "$PANVO_HOME"/{interfaces,components,drivers} -newer "$1/.panvo_built" \( -name '*.cpp' -o -name '*.hpp' -o -name CMakeLists.txt \) \
    -not -path '*/test/*' -printf '%P\n' -quit 2>/dev/null || true
}

# ensure_built TARGET...: installs missing packages and builds; does nothing in an installed panvo.
ensure_built() {
  in_checkout || return 0
  ensure_packages build
  [[ $PANVO_BUILD != @(clang|fuzz) ]] || ensure_packages clang
  [[ $PANVO_BUILD != arm64 ]] || prepare_arm64
  build_targets "$@"
}

# program NAME: path of a panvo executable, built or installed.
program() {
  local candidate
  if in_checkout; then
    candidate=$(build_folder)/panvo_bin/$1
  else
    candidate=$(readlink -m -- "$PANVO_HOME/../../bin/$1")
    [[ -x $candidate ]] || candidate=$(command -v "$1" || true)
  fi
  [[ -n $candidate && -x $candidate ]] || fail "$1 not found; $(in_checkout && echo "run 'panvo build'" || echo "$(package_of "$1"), or source the setup.bash of the installed workspace")"
  printf '%s' "$candidate"
}

# package_of PROGRAM: which Debian package has it.
package_of() { echo "install the package $([[ $1 == panvo_simulat* ]] && echo panvo-simulation || echo panvo)"; }

# use_plugins: sets PANVO_PLUGIN_PATH and PATH for the build; plugin folders given by the user come first.
use_plugins() {
  in_checkout || return 0
  local folder
  folder=$(build_folder)
  export PANVO_PLUGIN_PATH="${PANVO_PLUGIN_PATH:+$PANVO_PLUGIN_PATH:}$folder/panvo_plugins"
  export PATH="$folder/panvo_bin:$PATH"
}

# start_program NAME ARGUMENT...: replaces this shell by the program.
start_program() {
  local name=$1 path
  shift
  use_built "$name"
  use_plugins
  path=$(program "$name")
  [[ $PANVO_BUILD != arm64 ]] || exec_arm64 "$path" "$@"
  exec "$path" "$@"
}

# show_program_help NAME: prints the program's own --help if it is built; --help never starts a build.
show_program_help() {
  local path
  path=$(program "$1" 2>/dev/null) || {
    printf '\n(To see all options here, %s.)\n' "$(if in_checkout; then echo 'run "panvo build"'; else package_of "$1"; fi)"
    return 0
  }
  printf '\n'
  use_plugins
  "$path" --help
}
