# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: inspect recorded bags: panvo bag info BAG

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo bag info BAG

What a recorded bag holds: topics, types, counts, duration.
EOT
  show_program_help panvo_bag
}

verb_main() { start_program panvo_bag "$@"; }
