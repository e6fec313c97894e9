# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: inspect, draw, merge and copy landmark stores

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo landmarks info | show | merge | copy ...
       panvo landmarks junctions DATASET [options]    (see panvo landmarks junctions --help)

A landmark store holds the places that a run can recognise: one SQLite file, or a PostgreSQL database for several robots.
EOT
  show_program_help panvo_landmarks
}

verb_main() {
  if [[ ${1:-} == junctions ]]; then
    shift
    start_program panvo_junctions "$@"
  else
    start_program panvo_landmarks "$@"
  fi
}
