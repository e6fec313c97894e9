# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: read and set the parameters of running nodes

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo param list [NODE] | get NODE NAME | set NODE NAME VALUE | describe NODE [NAME]

Most parameters of panvo components are read-only after construction; describe shows which can be changed.
EOT
  show_program_help panvo_graph
}

verb_main() { start_program panvo_graph param "$@"; }
