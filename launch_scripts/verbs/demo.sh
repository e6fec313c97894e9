# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: from nothing to two paths over the truth: install, build, simulate a journey, run the system, evaluate, draw

source "$PANVO_SCRIPTS/lib/build.sh"
source "$PANVO_SCRIPTS/lib/supervise.sh"
source "$PANVO_SCRIPTS/lib/systems.sh"
source "$PANVO_SCRIPTS/lib/datasets.sh"
source "$PANVO_SCRIPTS/lib/simulated.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo demo [--full] [--seed N] [--effects LIST] [--dataset DIR] [--out DIR] [--replay]

Installs and builds what is missing, drives the route 'short' through the simulated campus (rendered once, some minutes, and
kept for the next time) with stereo cameras whose calibration has aged, through traffic, rain and sudden light, and runs the whole system
on it in one container: stereo odometry, places, compass, localizer, a recorder beside them. Then it compares both paths with the truth,
the odometry's that drifts and the one that places correct, and writes a page that shows it all.

  --full          the journeys of the paper instead: 'dataset_i' (3.1 km), then 'dataset_ii' (1.4 km) on the places of the first; to be
                  rendered once, which takes most of an hour on two cores (and goes on where it was when it is interrupted)
  --seed N        another campus (default: 4; with --full 1)
  --effects LIST  what makes the drive hard, as of 'panvo simulate' (default: all; with --full none)
  --dataset DIR   a recording of your own instead of the simulation
  --out DIR       a new folder for the results (default: runs/demo-1, demo-2, ...)
  --replay        one thread, in order of stamps, the same result bit for bit every time (default: a thread for each
                  component, as fast as they take it)
EOT
  printf '\n'
  dataset_layouts
}

verb_main() {
  local dataset='' out='' full='' seed='' effects='' route
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
        [[ $2 =~ ^[0-9]+$ ]] || fail "--seed takes a number, not '$2'" 2
        seed=$2
        shift
        ;;
      --effects)
        require_value "$@"
        [[ $2 =~ ^[a-z_]+(,[a-z_]+)*$ ]] || fail "--effects takes names with commas between, all or none, not '$2'" 2
        effects=$2
        shift
        ;;
      --full) full=yes ;;
      --replay) mode=(--replay) ;;
      *) unknown_option "$1" ;;
    esac
    shift
  done
  [[ -z $seed || -z $dataset ]] || fail "--seed is of the simulated journeys; it goes without --dataset" 2
  [[ -z $effects || -z $dataset ]] || fail "--effects is of the simulated journeys; it goes without --dataset" 2
  [[ -z $full || -z $dataset ]] || fail "--full is of the simulated journeys; it goes without --dataset" 2
  # Before anything is installed or built: is there something to play?
  if [[ -n $dataset ]]; then
    [[ -n $(dataset_kind "$dataset") ]] || fail "'$dataset' is no recording that panvo understands.

$(dataset_layouts)"
    dataset=$(readlink -f -- "$dataset")
  fi
  out=$(claim_folder "$out")
  ! in_checkout || ensure_packages build  # which may ask for a password
  supervise show_all
}

# show_all: with the variables of verb_main.
show_all() {
  ensure_built panvo_programs
  use_plugins
  if [[ -n $dataset ]]; then
    play_and_show "$dataset" "$out"
  elif [[ -z $full ]]; then
    dataset=$(simulated_dataset short "${seed:-4}" "${effects:-all}")
    play_and_show "$dataset" "$out"
  else
    library=(--set "landmark_store.file=$out/places.sqlite")
    for route in dataset_i dataset_ii; do
      dataset=$(simulated_dataset "$route" "${seed:-1}" "${effects:-none}")
      play_and_show "$dataset" "$out/$route" "${library[@]}"
      earlier=(--earlier "$dataset")
    done
  fi
}

# play_and_show DATASET OUT [OPTION...]: runs the system on a recording, and says what came of it.
play_and_show() {
  local dataset=$1 out=$2
  note "recording: $dataset ($(dataset_kind "$dataset"))"
  run_to_its_end "$out" "$(system_file demo)" --dataset "$dataset" "bag:=$out/bag" "${mode[@]}" "${@:3}"
  show_results "$dataset" "$out"
}

# claim_folder [DIR]: makes the folder for the results; one that has something in it is never written to.
claim_folder() {
  local out=$1 base n=1
  if [[ -n $out ]]; then
    [[ ! -e $out || -z $(ls -A -- "$out" 2>/dev/null || echo no) ]] ||
      fail "'$out' is there already and not empty; name a new folder with --out"
    mkdir -p -- "$out" || fail "'$out' cannot be made; name another folder with --out"
  else
    base=$(runs_folder)
    mkdir -p -- "$base" || fail "'$base' cannot be made; name a folder with --out"
    until mkdir -- "$base/demo-$n" 2>/dev/null; do n=$((n + 1)); done
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
    # 3: everything was measured, only the plot could not be drawn.
    ((status == 0 || status == 3)) || fail "evaluating failed; the run itself is in $out"
    if [[ -d $dataset/mav0/cam2 ]]; then
      printf '\n'
      "$(program panvo_evaluate_journey)" "$out" --recording "$dataset" --out "$out" "${earlier[@]}" || status=$?
      ((status == 0 || status == 3)) || fail "evaluating the journey failed; the run itself is in $out"
    fi
  fi
  cat <<EOT

Results in $out
$(result_line 'page' "$out/report.html")
$(result_line 'plot' "$out/evaluation.png")
$(result_line 'paths' "$out/odometry_enhanced.tum")
$(result_line '' "$out/odometry_binocular.tum")
$(result_line 'bag' "$out/bag")
$(result_line 'times' "$out/timing.json")
$(result_line 'summary' "$out/summary.json")

What to try next:
  panvo bag info $out/bag
EOT
  [[ -z $truth ]] || printf '  panvo evaluate %q %q\n' "$out" "$truth"
  cat <<EOT
  panvo run enhanced_vo --dataset $(printf %q "$dataset") --out runs/mine --replay
  panvo component list
EOT
  [[ -n $truth ]] || note "this recording has no ground truth: nothing to compare with, so there is no plot of errors"
}

result_line() { [[ ! -e $2 ]] || printf '  %-11s %s' "$1" "$2"; }
