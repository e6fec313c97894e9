# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: list running nodes, panvo's and ROS 2's, and what each has

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo node list | info NODE

The nodes of the DDS domain (ROS_DOMAIN_ID); "panvo node info --help" and so on say more.
EOT
  show_program_help panvo_graph
}

verb_main() { start_program panvo_graph node "$@"; }
