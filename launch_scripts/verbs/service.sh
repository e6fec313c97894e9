# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: list and call the services of running nodes

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo service list [-t] | call SERVICE [TYPE] [REQUEST]

REQUEST is YAML, for example: panvo service call /panvo/_container/list_nodes '{}'
EOT
  show_program_help panvo_graph
}

verb_main() { start_program panvo_graph service "$@"; }
