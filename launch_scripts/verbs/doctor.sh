# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: examine this machine and the DDS domain: what is wrong, and how to fix it

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo doctor [--domain N] [--timeout SECONDS]

Examines what panvo needs of the machine (shared memory, socket buffers, network, clock, cameras), the environment variables that it honours,
and the nodes of the domain: equal names, topics whose types or quality of service do not fit, several clocks. Says how to fix what is wrong.
Exit status 1 if something does not work.
EOT
  show_program_help panvo_graph
}

verb_main() { start_program panvo_graph doctor "$@"; }
