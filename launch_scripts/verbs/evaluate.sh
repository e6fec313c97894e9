# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: evaluate a trajectory, a journey or place recognition against ground truth: tables, HTML report, plots

source "$PANVO_SCRIPTS/lib/build.sh"
source "$PANVO_SCRIPTS/lib/supervise.sh"
source "$PANVO_SCRIPTS/lib/systems.sh"
source "$PANVO_SCRIPTS/lib/bags.sh"
source "$PANVO_SCRIPTS/lib/datasets.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo evaluate ESTIMATE GROUND_TRUTH [options]
       panvo evaluate journey RECORDING|RUN [options] (see panvo evaluate journey --help)
       panvo evaluate places RECORDING|FOLDER [options] (see panvo evaluate places --help)

ESTIMATE is a run folder, a trajectory (TUM, EuRoC csv, KITTI poses) or a bag with panvo's odometry, GROUND_TRUTH a data set, a
trajectory or a bag with ground_truth/odometry. Prints a table; writes evaluation.json, errors.csv and the plot into the run folder, or
into --out.

A bag is a rosbag2 folder or one .db3 or .mcap file. The files of its run are derived from its messages into the folder BAG.results, or
into a new temporary folder if that cannot be written; an earlier BAG.results is replaced.
EOT
  show_program_help panvo_evaluate
}

journey_usage() {
  cat <<'EOT'
usage: panvo evaluate journey RECORDING [--out DIR] [--library FILE] [--set C.P=V ...] [options]
       panvo evaluate journey RECORDING --run RUN [options]
       panvo evaluate journey RUN [options]

RUN is a run folder, or a bag of a run (see panvo evaluate --help).
Replays RECORDING through the system enhanced_vo, without panoramas stereo_places, or reads an existing run, and reports the error before and
after each revisit, the errors of both trajectories, and the time each stage took: as tables and in report.html.
drive.html is the page of 'panvo view' with this drive, its pictures, and a cursor that moves along it.

  --run RUN        evaluate this run of RECORDING instead of a new one
  --library FILE   landmark store of an earlier journey (landmark_store.file); new landmarks are added to it. Also name that
                   journey's recording with --earlier: its start is the origin of the map
  --set C.P=V      set parameter P of component C
  --out DIR        folder for run and report (default: runs/journey-NAME)

EOT
  show_program_help panvo_evaluate_journey
}

verb_main() {
  case ${1:-} in
    places) start_program panvo_evaluate_places "${@:2}" ;;
    journey) supervise evaluate_journey "${@:2}" ;;
    *) if names_bag "$@"; then supervise evaluate_bags "$@"; else start_program panvo_evaluate "$@"; fi ;;
  esac
}

# is_recorded_run PATH: whether PATH is a bag; a run folder or a data set that has a bag in it is not.
is_recorded_run() {
  is_bag "$1" && [[ ! -e $1/odometry_binocular.tum && ! -e $1/odometry_enhanced.tum && -z $(dataset_ground_truth "$1") ]]
}

# names_bag ARGUMENT...: whether an argument, or the path in NAME=PATH, is a bag.
names_bag() {
  local argument
  for argument; do
    if is_recorded_run "$argument" || is_recorded_run "${argument#*=}"; then return; fi
  done
  return 1
}

# evaluate_bags ARGUMENT...: runs panvo_evaluate with the results of bags in place of the bags.
evaluate_bags() {
  local estimate='' run='' path
  local -a arguments=()
  use_built panvo_run panvo_evaluate
  use_plugins
  while (($#)); do
    case $1 in
      --also | --name | --out | --align | --segments | --segment-step | --associate | --tolerance | --nees-steps | --truth-noise-m | --truth-noise-deg | --title)
        require_value "$@"
        path=${2#*=}
        if [[ $1 == --also ]] && is_recorded_run "$path"; then
          path=$(run_of_bag "$path")
          arguments+=("$1" "${2%%=*}=$path")
        else
          arguments+=("$1" "$2")
        fi
        shift
        ;;
      -*) arguments+=("$1") ;;
      *)
        path=$1
        if [[ -z $estimate ]]; then
          estimate=$1
          ! is_recorded_run "$path" || path=$(run_of_bag "$path")
          run=$path
        elif is_recorded_run "$path"; then
          if [[ $1 == "$estimate" ]]; then path=$run; else path=$(results_of_bag "$path"); fi
          path+=/ground_truth.tum
          [[ -s $path ]] || fail "'$1' holds no ground truth (ground_truth/odometry); name a data set or a trajectory"
        fi
        arguments+=("$path")
        ;;
    esac
    shift
  done
  exec "$(program panvo_evaluate)" "${arguments[@]}"
}

evaluate_journey() {
  local recording='' run='' out=''
  local -a settings=() options=()
  while (($#)); do
    case $1 in
      -h | --help)
        journey_usage
        return
        ;;
      --run | --out | --library | --set | --recording | --earlier | --paper-run | --title | --video | --video-speed)
        require_value "$@"
        case $1 in
          --run) run=$2 ;;
          --out) out=$2 ;;
          --library) settings+=(--set "landmark_store.file=$2") ;;
          --set) settings+=(--set "$2") ;;
          *) options+=("$1" "$2") ;;
        esac
        shift
        ;;
      -*) options+=("$1") ;;
      *)
        [[ -z $recording ]] || fail "only one recording is allowed: '$recording' or '$1'?" 2
        recording=$1
        ;;
    esac
    shift
  done
  [[ -n $recording ]] || fail "name a recording or a run (panvo evaluate journey --help)" 2
  [[ -d $recording || -f $recording ]] || fail "recording or run '$recording' not found"

  use_built panvo_run panvo_evaluate_journey
  use_plugins
  if [[ -f $recording/odometry_enhanced.tum ]] || is_recorded_run "$recording"; then
    [[ -z $run ]] || fail "'$recording' is a run, not a recording; with --run, name the recording that was played" 2
    run=$recording
  elif [[ -d $recording ]]; then
    options+=(--recording "$recording")
  else
    fail "'$recording' is neither a folder nor a bag"
  fi
  ! is_recorded_run "$run" || run=$(run_of_bag "$run")
  [[ -n $run ]] || make_run
  [[ -z $out ]] || options+=(--out "$out")
  exec "$(program panvo_evaluate_journey)" "$run" "${options[@]}"
}

# make_run: plays $recording into $out and sets $run.
make_run() {
  local system
  system=$(system_file enhanced_vo)
  [[ -n $(dataset_panorama "$recording") ]] || system=$(system_file stereo_places)
  if [[ -z $out ]]; then
    out=$(runs_folder)/journey-$(basename -- "$(readlink -f -- "$recording")")
  fi
  note "playing $recording into $out"
  run_to_its_end "$out" "$system" --dataset "$recording" --replay "${settings[@]}" >&2
  run=$out
}
