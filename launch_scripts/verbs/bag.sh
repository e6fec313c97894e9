# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: inspect, check, mend, copy and compare recorded bags

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo bag info | check | reindex | copy | diff ...

Bags are rosbag2 folders: metadata.yaml and SQLite .db3 files.
EOT
  show_program_help panvo_bag
}

verb_main() { start_program panvo_bag "$@"; }
