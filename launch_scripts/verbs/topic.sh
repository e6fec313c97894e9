# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: list topics, print their messages, measure rate and bandwidth

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo topic list [-t] | info TOPIC [-v] | echo TOPIC [--once] | hz TOPIC | bw TOPIC

Topics of any DDS peer that follows ROS 2's names; echo reads the message types that panvo has.
EOT
  show_program_help panvo_graph
}

verb_main() { start_program panvo_graph topic "$@"; }
