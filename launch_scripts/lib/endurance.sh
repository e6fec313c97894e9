# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# panvo bench endurance: plays hours of driving through the whole system and checks memory, file descriptors and threads.

source "$PANVO_SCRIPTS/lib/simulated.sh"

endurance_usage() {
  cat <<'EOT'
usage: panvo bench endurance [--hours H] [--rate R] [--faults KIND] [--dataset DIR] [--out DIR]

Plays a recording forward and backward through the whole system, live, for H recorded hours, with a different fault every 20 s, and monitors the
process. It must exit with status 0; its memory must not change by more than 5 % between the first part of the run (after warm-up, a fifth of the run)
and the last; the numbers of file descriptors and threads must not change.

  --hours H      recorded time, h (default: 6)
  --rate R       playback speed relative to the recording (default: 4)
  --faults KIND  a kind from panvo bench faults --list, or none (default: mixed)
  --dataset DIR  EuRoC/ASL with stereo pairs and panoramas (default: a simulated drive along the route 'short', rendered once and cached)
  --out DIR      folder for the results (default: runs/endurance): samples.csv, samples.png, output.log

Exit status 0: all conditions hold.
EOT
}

bench_endurance() {
  local hours=6 rate=4 faults=mixed dataset='' out=$PANVO_HOME/runs/endurance length_s passes
  while (($#)); do
    case $1 in
      -h | --help)
        endurance_usage
        return
        ;;
      --hours | --rate | --faults | --dataset | --out)
        require_value "$@"
        printf -v "${1#--}" '%s' "$2"
        shift
        ;;
      *) unknown_option "$1" ;;
    esac
    shift
  done
  ensure_built panvo_programs panvo_fault_bench
  use_plugins
  [[ -n $dataset ]] || dataset=$(simulated_dataset short 4 all)
  length_s=$(recorded_seconds "$dataset")
  passes=$(awk -v hours="$hours" -v length_s="$length_s" 'BEGIN { print int((3600 * hours + length_s - 1) / length_s) }')
  note "playing $dataset ($length_s s) $passes times at rate $rate"
  python3 "$PANVO_HOME/tests/endurance/endurance.py" --out "$out" -- "$(program panvo_run)" "$PANVO_HOME/tests/fault_bench/faults.yaml" \
    dataset:="$dataset" kind:="$faults" span_s:="$(awk -v hours="$hours" 'BEGIN { print 3600 * hours }')" --rate "$rate" --set dataset_player.passes="$passes"
}

# recorded_seconds DATASET: time from the first stereo pair to the last, s.
recorded_seconds() {
  local times=$1/mav0/cam0/data.csv
  [[ -f $times ]] || fail "$times not found: '$1' has no EuRoC/ASL stereo images"
  awk -F, '/^[0-9]/ { if (!first) first = $1; last = $1 } END { if (last <= first) exit 1; printf "%.3f", (last - first) * 1e-9 }' "$times" ||
    fail "$times has fewer than two stamps"
}
