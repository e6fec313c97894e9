# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: run the benchmarks

source "$PANVO_SCRIPTS/lib/build.sh"
source "$PANVO_SCRIPTS/lib/accuracy.sh"
source "$PANVO_SCRIPTS/lib/endurance.sh"
source "$PANVO_SCRIPTS/lib/faults.sh"
source "$PANVO_SCRIPTS/lib/places_bench.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo bench [NAME...] [-- argument...]
       panvo bench accuracy [option...]         errors over simulated drives, with intervals (panvo bench accuracy --help)
       panvo bench places [option...]           recognition on other days (panvo bench places --help)
       panvo bench faults [option...]           fault injection into the whole system (panvo bench faults --help)
       panvo bench endurance [option...]        hours of driving, checks for leaks (panvo bench endurance --help)
       panvo bench report [--quick] [--out FILE]  measures accuracy on recordings and all times; writes them as one Markdown page
                                                (default: runs/report.md)

Runs all programs of tests/benchmarks, or those whose name contains NAME. Arguments after -- are passed to Google Benchmark,
for example: panvo bench odometry -- --benchmark_filter=klt --benchmark_format=json
EOT
}

verb_main() {
  require_checkout
  case ${1:-} in
    accuracy | endurance | faults | places | report)
      "bench_$1" "${@:2}"
      return
      ;;
  esac
  local -a names=() arguments=()
  while (($#)); do
    case $1 in
      --)
        shift
        arguments=("$@")
        break
        ;;
      --benchmark_*) arguments+=("$1") ;;
      -*) unknown_option "$1" ;;
      *) names+=("$1") ;;
    esac
    shift
  done
  ensure_built panvo_programs panvo_benchmarks
  use_plugins
  local data path name wanted ran=0 failed=0
  data=$(data_folder)
  [[ -z $data ]] || export PANVO_DATA=$data
  for path in "$(build_folder)"/panvo_bin/*_benchmark; do
    [[ -x $path ]] || continue
    wanted=$((${#names[@]} == 0))
    for name in "${names[@]}"; do
      [[ $(basename "$path") != *"$name"* ]] || wanted=1
    done
    ((wanted)) || continue
    ran=$((ran + 1))
    note "$(basename "$path")"
    "$path" "${arguments[@]}" || failed=$((failed + 1))
  done
  ((ran)) || fail "no benchmark matches; available: $(list_benchmarks)"
  ((failed == 0)) || fail "$failed of $ran benchmark programs failed"
}

bench_report() {
  local out=$PANVO_HOME/runs/report.md data
  local -a options=()
  while (($#)); do
    case $1 in
      --quick) options+=(--quick) ;;
      --out)
        require_value "$@"
        out=$2
        shift
        ;;
      *) unknown_option "$1" ;;
    esac
    shift
  done
  data=$(data_folder)
  [[ -n $data ]] || fail "no recordings: set PANVO_DATA to a folder of recordings (panvo data lists public ones)"
  ensure_built panvo_programs panvo_benchmarks
  use_plugins
  mkdir -p -- "$(dirname -- "$out")" || fail "cannot create the folder of '$out'; name another file with --out"
  exec python3 -B "$PANVO_HOME/tests/benchmarks/report.py" "${options[@]}" --programs "$(build_folder)/panvo_bin" \
    --systems "$PANVO_HOME/config/systems" --data "$data" --work "$PANVO_HOME/runs/report" --out "$out" --version-text "$(panvo_version)"
}

list_benchmarks() { find "$(build_folder)/panvo_bin" -name '*_benchmark' -printf '%f ' 2>/dev/null; }
