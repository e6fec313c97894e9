# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: list components and their parameters; load and unload components in running containers

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo component list | show PACKAGE
       panvo component running | load CONTAINER PACKAGE PLUGIN ... | unload CONTAINER ID...

list and show: the installed components, with the unit, default and range of each parameter ("types" is an alias of list).
running, load and unload: the containers running in the DDS domain, as with "ros2 component"; each has its own help, such as
"panvo component load --help".
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
