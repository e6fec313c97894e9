# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: measure a trajectory against ground truth: table, plot, JSON

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo evaluate ESTIMATE GROUND_TRUTH [options]

ESTIMATE is the folder of a run, or a trajectory (TUM, EuRoC csv, KITTI poses); GROUND_TRUTH a data set, or a trajectory.
Prints a table; writes evaluation.json, errors.csv and the plot into the folder of the run, or into --out.
EOT
  show_program_help panvo_evaluate
}

verb_main() { start_program panvo_evaluate "$@"; }
