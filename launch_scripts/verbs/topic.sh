# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: list topics, print messages, measure rate and bandwidth

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo topic list [-t] | info TOPIC [-v] | echo TOPIC [--once] | hz TOPIC | bw TOPIC

Topics of all DDS peers that follow the naming convention of ROS 2. echo prints messages of panvo's interfaces, and of your own packages if their
workspace is sourced.
EOT
  show_program_help panvo_graph
}

verb_main() { start_program panvo_graph topic "$@"; }
