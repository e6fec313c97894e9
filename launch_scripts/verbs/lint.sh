# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: check formatting, naming and likely bugs in the sources

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo lint [--format | --naming | --tidy | --scripts] [--fix] [FILE...]

Without an option: --format and --scripts, as in CI. FILE: check only these files (default: every C++ source). A fast naming check is part
of the tests.

  --format    formatting with clang-format and .clang-format
  --naming    only the naming rules of .clang-tidy, on concatenated sources for speed; minutes for the whole tree
  --tidy      every check of .clang-tidy; minutes for the whole tree
  --scripts   shellcheck on the shell scripts
  --fix       with --format: rewrite the files
EOT
}

verb_main() {
  require_checkout
  local fix=no status=0 check
  local -a checks=() files=()
  while (($#)); do
    case $1 in
      --format | --naming | --tidy | --scripts) checks+=("${1#--}") ;;
      --fix) fix=yes ;;
      -*) unknown_option "$1" ;;
      *)
        [[ -f $1 ]] || fail "file '$1' not found" 2
        files+=("$(readlink -f -- "$1")")
        ;;
    esac
    shift
  done
  ((${#checks[@]})) || checks=(format scripts)
  ensure_packages build lint
  ((${#files[@]})) || mapfile -t files < <(sources -name '*.cpp' -o -name '*.hpp')
  for check in "${checks[@]}"; do
    "lint_$check" "${files[@]}" || status=1
  done
  ((status == 0)) || fail "problems found, listed above; 'panvo lint --format --fix' corrects the formatting"
  note "no problems found: ${checks[*]}"
}

# sources FIND_EXPRESSION...: files of the checkout outside the folders of builds and runs; works without git.
sources() {
  local name
  local -a left=(-path "$PANVO_HOME/.git")
  for name in build install log runs; do left+=(-o -path "$PANVO_HOME/$name"); done
  find "$PANVO_HOME" \( "${left[@]}" \) -prune -o -type f \( "$@" \) -print | sort
}

lint_format() {
  note "formatting of $# files"
  if [[ $fix == yes ]]; then
    clang-format -i "$@"
  else
    clang-format --dry-run -Werror "$@"
  fi
}

lint_naming() {
  note "naming rules"
  local PANVO_BUILD=debug  # its compilation database lists every source
  build_targets panvo_interfaces_generate
  python3 "$PANVO_HOME/tests/lint/tidy.py" --build "$(build_folder)" --naming --jobs "$(job_count)" "$@"
}

lint_tidy() {
  note "clang-tidy on $# files"
  local PANVO_BUILD=debug  # its compilation database lists every source
  build_targets panvo_interfaces_generate
  python3 "$PANVO_HOME/tests/lint/tidy.py" --build "$(build_folder)" --jobs "$(job_count)" "$@"
}

lint_scripts() {
  local -a shell_files
  mapfile -t shell_files < <(sources -path '*/launch_scripts/panvo' -o -name '*.sh' -o -path '*/.ci/*')
  note "shellcheck on ${#shell_files[@]} scripts"
  (cd "$PANVO_HOME" && shellcheck -x -P "$PANVO_HOME" "${shell_files[@]}")
}
