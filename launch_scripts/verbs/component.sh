# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: list components and their parameters; load and unload them in running containers

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo component list | show PACKAGE
       panvo component running | load CONTAINER PACKAGE PLUGIN ... | unload CONTAINER ID...

list and show: the components that are found, with their parameters, units, defaults and ranges ("types" is another word for list).
running, load and unload: the containers that run in the DDS domain, as "ros2 component" has them; "panvo component load --help" and so
on say more.
EOT
  show_program_help panvo_component
}

verb_main() {
  case ${1:-} in
    running | load | unload) start_program panvo_graph component "$@" ;;
    types) start_program panvo_component list "${@:2}" ;;
    *) start_program panvo_component "$@" ;;
  esac
}
