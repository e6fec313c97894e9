# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: list running panvo and ROS 2 nodes, with their topics and services

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo node list | info NODE

The nodes in the DDS domain (ROS_DOMAIN_ID). Each command has its own help, such as "panvo node info --help".
EOT
  show_program_help panvo_graph
}

verb_main() { start_program panvo_graph node "$@"; }
