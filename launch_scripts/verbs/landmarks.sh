# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: inspect, draw and merge libraries of landmarks

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo landmarks info | show | merge ...
       panvo landmarks junctions DATASET [options]    (panvo landmarks junctions --help says more)

A library of landmarks is one SQLite file: the places that a run may recognise, and how each looks.
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
