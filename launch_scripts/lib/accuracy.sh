# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# panvo bench accuracy: replays simulated drives of several seeds through the whole system and prints their errors.

source "$PANVO_SCRIPTS/lib/simulated.sh"
source "$PANVO_SCRIPTS/lib/bench_page.sh"

accuracy_usage() {
  cat <<'EOT'
usage: panvo bench accuracy [--quick] [--seeds S,...] [--route ROUTE] [--journey ROUTE] [--out FILE]

Renders drives with ground truth, replays each through the whole system, also with gyroscope, wheels and satellites, and prints a table of errors
with their 95 % intervals: position, heading, after revisits, consistency, CPU time and memory. Drives are rendered once and cached.

  --quick          one seed and shorter drives; about ten minutes of two cores, without it an hour
  --seeds LIST     seeds of the drives (default: 301,302,303)
  --route ROUTE    route of the drives with stereo images (default: short); see panvo simulate --help
  --journey ROUTE  route of the drives with panoramas only, whose odometry is modelled (default: dataset_i, 3.1 km)
  --out FILE       the page (default: runs/accuracy.md)
EOT
}

bench_accuracy() {
  local route=short journey=dataset_i list=301,302,303 out=$PANVO_HOME/runs/accuracy.md seed quick=''
  local -a seeds aged=() disturbed=() long=() groups=()
  while (($#)); do
    case $1 in
      -h | --help)
        accuracy_usage
        return
        ;;
      --quick)
        quick=yes
        journey=dataset_ii
        list=301
        ;;
      --seeds | --route | --journey | --out)
        require_value "$@"
        case $1 in
          --seeds) list=$2 ;;
          *) printf -v "${1#--}" '%s' "$2" ;;
        esac
        shift
        ;;
      *) unknown_option "$1" ;;
    esac
    shift
  done
  split_seeds "$list"
  prepare_page "$out"
  for seed in "${seeds[@]}"; do
    aged+=("$(simulated_dataset "$route" "$seed" none)")
    [[ -n $quick ]] || disturbed+=("$(simulated_dataset "$route" "$seed" all)")
    long+=("$(simulated_panoramas "$journey" "$seed")")
  done
  groups=(--drives stereo "$route" "${aged[@]}")
  [[ -n $quick ]] || groups+=(--drives stereo "$route, all effects" "${disturbed[@]}")
  groups+=(--drives panorama "$journey, panoramas" "${long[@]}")
  exec python3 -B "$PANVO_HOME/tests/benchmarks/accuracy.py" "${groups[@]}" --programs "$(build_folder)/panvo_bin" \
    --work "$PANVO_HOME/runs/accuracy" --out "$out" --version-text "$(panvo_version)"
}
