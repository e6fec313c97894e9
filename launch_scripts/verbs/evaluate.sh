# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: measure a trajectory, or the recognition of places, against ground truth: table, plot, JSON

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo evaluate ESTIMATE GROUND_TRUTH [options]
       panvo evaluate places RECORDING [options]      (panvo evaluate places --help says more)

ESTIMATE is the folder of a run, or a trajectory (TUM, EuRoC csv, KITTI poses); GROUND_TRUTH a data set, or a trajectory.
Prints a table; writes evaluation.json, errors.csv and the plot into the folder of the run, or into --out.
EOT
  show_program_help panvo_evaluate
}

verb_main() {
  if [[ ${1:-} == places ]]; then
    shift
    start_program panvo_evaluate_places "$@"
  else
    start_program panvo_evaluate "$@"
  fi
}
