# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: inspect, check, repair, convert, cut and compare bags

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo bag info | check | reindex | copy | convert | slice | diff ...

A bag is a rosbag2 folder with metadata.yaml and .db3 (SQLite) or .mcap files, compressed or not, or a single such file.
EOT
  show_program_help panvo_bag
}

verb_main() { start_program panvo_bag "$@"; }
