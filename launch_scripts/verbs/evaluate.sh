# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: measure a trajectory, a journey, or the recognition of places against ground truth: tables, a page, plots

source "$PANVO_SCRIPTS/lib/build.sh"
source "$PANVO_SCRIPTS/lib/supervise.sh"
source "$PANVO_SCRIPTS/lib/systems.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo evaluate ESTIMATE GROUND_TRUTH [options]
       panvo evaluate journey RECORDING|RUN [options] (panvo evaluate journey --help says more)
       panvo evaluate places RECORDING [options]      (panvo evaluate places --help says more)

ESTIMATE is the folder of a run, or a trajectory (TUM, EuRoC csv, KITTI poses); GROUND_TRUTH a data set, or a trajectory.
Prints a table; writes evaluation.json, errors.csv and the plot into the folder of the run, or into --out.
EOT
  show_program_help panvo_evaluate
}

journey_usage() {
  cat <<'EOT'
usage: panvo evaluate journey RECORDING [--out DIR] [--library FILE] [--set C.P=V ...] [options]
       panvo evaluate journey RECORDING --run DIR [options]
       panvo evaluate journey RUN [options]

Plays RECORDING through the enhanced odometry (system enhanced_vo, replayed), or takes a run that was made of it, and says what
each revisit did to the error, how far off both paths are, and how long each stage took: tables, and report.html to show.

  --run DIR        evaluate this run of RECORDING instead of making one
  --library FILE   landmarks of an earlier journey (landmark_store.file); new ones are added to it. With it, name that journey's
                   recording with --earlier, so that its start is known to be the map's
  --set C.P=V      set a parameter of the run
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
        [[ -z $recording ]] || fail "one recording at a time: '$recording', and then '$1'?" 2
        recording=$1
        ;;
    esac
    shift
  done
  [[ -n $recording ]] || fail "which recording, or which run? (panvo evaluate journey --help)" 2
  [[ -d $recording ]] || fail "'$recording' is no folder"

  use_built panvo_run panvo_evaluate_journey
  use_plugins
  if [[ -f $recording/odometry_enhanced.tum ]]; then
    [[ -z $run ]] || fail "'$recording' is a run itself; with --run, name the recording it was made of" 2
    run=$recording
  else
    options+=(--recording "$recording")
  fi
  [[ -n $run ]] || make_run
  [[ -z $out ]] || options+=(--out "$out")
  exec "$(program panvo_evaluate_journey)" "$run" "${options[@]}"
}

# make_run: a run of $recording in $out, which is then named by $run.
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
