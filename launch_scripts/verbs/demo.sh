# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: end-to-end demo: install, build, simulate a drive, run the system, plot both trajectories against ground truth

source "$PANVO_SCRIPTS/lib/build.sh"
source "$PANVO_SCRIPTS/lib/supervise.sh"
source "$PANVO_SCRIPTS/lib/systems.sh"
source "$PANVO_SCRIPTS/lib/datasets.sh"
source "$PANVO_SCRIPTS/lib/simulated.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo demo [--full] [--seed N] [--effects LIST] [--dataset DIR] [--out DIR] [--replay] [--live]

Installs and builds what is missing, renders a drive along the route 'short' of the simulated campus (several minutes of compute,
cached) with an aged stereo calibration, traffic, rain and sudden light changes, and runs the whole system on it in one container:
stereo odometry, places, compass, localizer, recorder. Then it compares two trajectories with ground truth, the drifting stereo odometry
and the one corrected at recognised places, and writes an HTML report.

  --full          the journeys of the paper: 'dataset_i' (3.1 km), then 'dataset_ii' (1.4 km) with the landmark store of the first.
                  Rendering them takes most of an hour on two cores, once; an interrupted rendering is resumed
  --seed N        random seed of the campus (default: 4; with --full 1)
  --effects LIST  effects, as in 'panvo simulate' (default: all; with --full none)
  --dataset DIR   use this recording instead of the simulation
  --out DIR       new folder for the results (default: runs/demo-1, demo-2, ...)
  --replay        one thread, in stamp order, bit-identical results (default: one thread per component, as fast as
                  possible)
  --live          show the drive in a browser while it is computed (http://127.0.0.1:8765), at the recorded speed unless --replay
EOT
  printf '\n'
  dataset_layouts
}

verb_main() {
  local dataset='' out='' full='' seed='' effects='' live='' route
  local -a mode=() library=() earlier=()
  while (($#)); do
    case $1 in
      --dataset)
        require_value "$@"
        dataset=$2
        shift
        ;;
      --out)
        require_value "$@"
        out=$2
        shift
        ;;
      --seed)
        require_value "$@"
        [[ $2 =~ ^[0-9]+$ ]] || fail "--seed must be a number, not '$2'" 2
        seed=$2
        shift
        ;;
      --effects)
        require_value "$@"
        [[ $2 =~ ^[a-z_]+(,[a-z_]+)*$ ]] || fail "--effects must be all, none or names separated by commas, not '$2'" 2
        effects=$2
        shift
        ;;
      --full) full=yes ;;
      --replay) mode=(--replay) ;;
      --live) live=yes ;;
      *) unknown_option "$1" ;;
    esac
    shift
  done
  [[ -z $seed || -z $dataset ]] || fail "--seed applies to simulated journeys only; it cannot be combined with --dataset" 2
  [[ -z $effects || -z $dataset ]] || fail "--effects applies to simulated journeys only; it cannot be combined with --dataset" 2
  [[ -z $full || -z $dataset ]] || fail "--full applies to simulated journeys only; it cannot be combined with --dataset" 2
  # Check the recording before anything is installed or built.
  if [[ -n $dataset ]]; then
    [[ -n $(dataset_kind "$dataset") ]] || fail "'$dataset' is not a recording in a supported layout.

$(dataset_layouts)"
    dataset=$(readlink -f -- "$dataset")
  fi
  if [[ -n $live ]]; then
    [[ -n ${mode[*]} ]] || mode=(--rate 1)
    mode+=(--view)
  fi
  out=$(claim_folder "$out")
  if in_checkout; then  # before supervise, because sudo may ask for a password
    ensure_packages build
    [[ -z $live ]] || install_if_possible page
  fi
  supervise show_all
}

# show_all: uses the variables of verb_main.
show_all() {
  if [[ -n $dataset ]]; then
    ensure_built "panvo_demo${live:+_live}"
    use_plugins
    play_and_show "$dataset" "$out"
  elif [[ -z $full ]]; then
    simulate_while_building short "${seed:-4}" "${effects:-all}"
    use_plugins
    play_and_show "$dataset" "$out"
  else
    ensure_built "panvo_demo${live:+_live}"
    use_plugins
    library=(--set "landmark_store.file=$out/places.sqlite")
    for route in dataset_i dataset_ii; do
      dataset=$(simulated_dataset "$route" "${seed:-1}" "${effects:-none}")
      play_and_show "$dataset" "$out/$route" "${library[@]}"
      earlier=(--earlier "$dataset")
    done
  fi
}

# simulate_while_building ROUTE SEED EFFECTS: sets `dataset` to the simulated drive. It is rendered during the rest of the build; its messages
# wait in a file until the build ends, because two progress lines do not fit on one terminal.
simulate_while_building() {
  local renderer log=$out/simulation.log
  ensure_built panvo_simulate
  : >"$log"  # it is read below, perhaps before the rendering has begun
  simulated_dataset "$@" >"$out/.dataset" 2>"$log" &
  renderer=$!
  ensure_built "panvo_demo${live:+_live}"
  tail --pid="$renderer" -s 0.2 -n +1 -f -- "$log" >&2
  wait "$renderer" || exit 1
  dataset=$(<"$out/.dataset")
  rm -f -- "$out/.dataset" "$log"
}

# play_and_show DATASET OUT [OPTION...]: runs the system on a recording and prints the results.
play_and_show() {
  local dataset=$1 out=$2
  note "recording: $dataset ($(dataset_kind "$dataset"))"
  run_to_its_end "$out" "$(system_file demo)" --dataset "$dataset" "bag:=$out/bag" "${mode[@]}" "${@:3}"
  show_results "$dataset" "$out"
}

# claim_folder [DIR]: creates the folder for the results and prints its path; fails if DIR is not empty.
claim_folder() {
  local out=$1 base n=1
  if [[ -n $out ]]; then
    [[ ! -e $out || -z $(ls -A -- "$out" 2>/dev/null || echo no) ]] ||
      fail "'$out' exists and is not empty; choose a new folder with --out"
    mkdir -p -- "$out" || fail "cannot create '$out'; choose another folder with --out"
  else
    base=$(runs_folder)
    mkdir -p -- "$base" || fail "cannot create '$base'; choose a folder with --out"
    until mkdir -- "$base/demo-$n" 2>/dev/null; do
      [[ -e $base/demo-$n ]] || fail "cannot create '$base/demo-$n'; choose a folder with --out"
      n=$((n + 1))
    done
    out=$base/demo-$n
  fi
  readlink -f -- "$out"
}

show_results() {
  local dataset=$1 out=$2 truth status=0
  truth=$(dataset_ground_truth "$dataset")
  if [[ -n $truth ]]; then
    printf '\n'
    "$(program panvo_evaluate)" "$out" "$truth" || status=$?
    # 3: evaluated, but the plot could not be drawn.
    ((status == 0 || status == 3)) || fail "evaluation failed; the run itself is in $out"
    if [[ -n $(dataset_panorama "$dataset") ]]; then
      printf '\n'
      "$(program panvo_evaluate_journey)" "$out" --recording "$dataset" --out "$out" "${earlier[@]}" || status=$?
      ((status == 0 || status == 3)) || fail "evaluation of the journey failed; the run itself is in $out"
    fi
  fi
  cat <<EOT

Results in $out
$(result_line 'report' "$out/report.html")
$(result_line 'drive' "$out/drive.html")
$(result_line 'plot' "$out/evaluation.png")
$(result_line 'paths' "$out/odometry_enhanced.tum")
$(result_line '' "$out/odometry_binocular.tum")
$(result_line 'bag' "$out/bag")
$(result_line 'times' "$out/timing.json")
$(result_line 'summary' "$out/summary.json")

Next steps:
  panvo bag info $(printf %q "$out/bag")
EOT
  [[ -z $truth ]] || printf '  panvo evaluate %q %q\n' "$out" "$truth"
  cat <<EOT
  panvo run enhanced_vo --dataset $(printf %q "$dataset") --out runs/mine --replay
  panvo component list
EOT
  [[ -n $truth ]] || note "this recording has no ground truth, so no errors were evaluated"
}

result_line() { [[ ! -e $2 ]] || printf '  %-11s %s' "$1" "$2"; }
