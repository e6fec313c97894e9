# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: recognise places in plain folders of panoramas, without a stereo camera

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo places build FOLDER --out LIBRARY [options]
       panvo places match FOLDER|IMAGE --library LIBRARY [options]

Only bearings are measured: the answer is a place, the heading and the direction from the place. Metres come from poses of the library.
`panvo evaluate places FOLDER` scores recognition in such a folder.
EOT
  show_program_help panvo_places
}

verb_main() {
  start_program panvo_places "$@"
}
