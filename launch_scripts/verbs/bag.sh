# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: inspect, check, mend, convert, cut and compare recorded bags

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo bag info | check | reindex | copy | convert | slice | diff ...

Bags are rosbag2 folders: metadata.yaml, and .db3 (SQLite) or .mcap files, compressed or not; or one such file.
EOT
  show_program_help panvo_bag
}

verb_main() { start_program panvo_bag "$@"; }
