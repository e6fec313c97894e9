# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: build, run all tests, print the counts

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo test [--sanitize KIND | --debug | --arch ARCH] [--colcon] [-R REGEX] [ctest argument...]

Builds incrementally and runs every test. The last line is "N passed, N failed, N skipped"; the exit status is 0 only if no test
failed. Tests that need recordings read $PANVO_DATA, or ../shared/data beside the checkout; without either they are skipped,
and the reason is printed.

  --sanitize KIND   address, undefined or thread, in a separate build
  --debug           use the unoptimised build
  --arch ARCH       arm64: cross-compile and run the tests under qemu's emulation, ten times slower or more
  --colcon          build and test package by package with colcon
  -R REGEX          only tests whose name matches; other ctest arguments (-E, -L, --repeat ...) are passed on as well
EOT
}

verb_main() {
  require_checkout
  local use_colcon=no folder status=0
  local -a arguments=()
  while (($#)); do
    case $1 in
      --sanitize)
        require_value "$@"
        PANVO_BUILD=$(sanitizer_build "$2")
        shift
        ;;
      --debug) PANVO_BUILD=debug ;;
      --arch)
        require_value "$@"
        PANVO_BUILD=$(arch_build "$2")
        shift
        ;;
      --colcon) use_colcon=yes ;;
      *) arguments+=("$1") ;;
    esac
    shift
  done
  local data
  data=$(data_folder)
  [[ -z $data ]] || export PANVO_DATA=$data
  set_sanitizer_options

  if [[ $use_colcon == yes ]]; then
    source "$PANVO_SCRIPTS/lib/colcon.sh"
    # shellcheck disable=SC2119  # colcon build gets no extra arguments
    colcon_build
    colcon_test "${arguments[@]}" || status=$?
    python3 "$PANVO_SCRIPTS/lib/test_report.py" --status "$status" "$colcon_build_base"/panvo_*/panvo_junit.xml
    return
  fi
  install_if_possible witness
  ensure_built all
  folder=$(build_folder)
  rm -f "$folder/panvo_junit.xml"
  # --test-dir keeps the working folder. ctest prints one line per test; --progress updates one line on a terminal.
  local -a progress=()
  [[ ! -t 1 ]] || progress=(--progress)
  local -a ctest=(ctest)
  [[ $PANVO_BUILD != arm64 ]] || ctest=(with_arm64 ctest)
  "${ctest[@]}" --test-dir "$folder" --parallel "${PANVO_JOBS:-$(nproc)}" --output-on-failure --no-tests=error \
    --output-junit "$folder/panvo_junit.xml" "${progress[@]}" "${arguments[@]}" || status=$?
  python3 "$PANVO_SCRIPTS/lib/test_report.py" --status "$status" "$folder/panvo_junit.xml"
}

# Every sanitizer report fails its test. Suppressions are in config/build, each with its reason. CMakePresets.json has the same options.
set_sanitizer_options() {
  local suppressions=$PANVO_HOME/config/build/$PANVO_BUILD.supp with=''
  [[ ! -f $suppressions ]] || with=":suppressions=$suppressions"
  case $PANVO_BUILD in
    asan)
      # Fast DDS 2.9 deletes the statistics of readers and writers through a base class without a virtual destructor.
      export ASAN_OPTIONS="detect_stack_use_after_return=1:new_delete_type_mismatch=0:${ASAN_OPTIONS:-}"
      export LSAN_OPTIONS="print_suppressions=0$with:${LSAN_OPTIONS:-}"
      ;;
    ubsan) export UBSAN_OPTIONS="print_stacktrace=1:halt_on_error=1$with:${UBSAN_OPTIONS:-}" ;;
    tsan) export TSAN_OPTIONS="halt_on_error=1$with:${TSAN_OPTIONS:-}" ;;
  esac
}
