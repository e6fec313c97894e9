# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: evaluate a trajectory, a journey or place recognition against ground truth: tables, HTML report, plots

source "$PANVO_SCRIPTS/lib/build.sh"
source "$PANVO_SCRIPTS/lib/supervise.sh"
source "$PANVO_SCRIPTS/lib/systems.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo evaluate ESTIMATE GROUND_TRUTH [options]
       panvo evaluate journey RECORDING|RUN [options] (see panvo evaluate journey --help)
       panvo evaluate places RECORDING [options]      (see panvo evaluate places --help)

ESTIMATE is a run folder or a trajectory (TUM, EuRoC csv, KITTI poses), GROUND_TRUTH a data set or a trajectory.
Prints a table; writes evaluation.json, errors.csv and the plot into the run folder, or into --out.
EOT
  show_program_help panvo_evaluate
}

journey_usage() {
  cat <<'EOT'
usage: panvo evaluate journey RECORDING [--out DIR] [--library FILE] [--set C.P=V ...] [options]
       panvo evaluate journey RECORDING --run DIR [options]
       panvo evaluate journey RUN [options]

Replays RECORDING through the system enhanced_vo, or reads an existing run, and reports the error before and after each revisit,
the errors of both trajectories, and the time each stage took: as tables and in report.html.

  --run DIR        evaluate this run of RECORDING instead of a new one
  --library FILE   landmark library of an earlier journey (landmark_store.file); new landmarks are added to it. Also name that
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
    *) start_program panvo_evaluate "$@" ;;
  esac
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
      --run | --out | --library | --set | --recording | --earlier | --paper-run | --title)
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
  [[ -d $recording ]] || fail "'$recording' is not a folder"

  use_built panvo_run panvo_evaluate_journey
  use_plugins
  if [[ -f $recording/odometry_enhanced.tum ]]; then
    [[ -z $run ]] || fail "'$recording' is a run, not a recording; with --run, name the recording that was played" 2
    run=$recording
  else
    options+=(--recording "$recording")
  fi
  [[ -n $run ]] || make_run
  [[ -z $out ]] || options+=(--out "$out")
  exec "$(program panvo_evaluate_journey)" "$run" "${options[@]}"
}

# make_run: plays $recording into $out and sets $run.
make_run() {
  local system
  system=$(system_file enhanced_vo)
  if [[ -z $out ]]; then
    out=$(runs_folder)/journey-$(basename -- "$(readlink -f -- "$recording")")
  fi
  note "playing $recording into $out"
  run_to_its_end "$out" "$system" --dataset "$recording" --replay "${settings[@]}" >&2
  run=$out
}
