# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: play a bag onto the network

source "$PANVO_SCRIPTS/lib/build.sh"
source "$PANVO_SCRIPTS/lib/systems.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo play BAG [--rate R] [--set bag_player.parameter=value ...]

Publishes the messages of a rosbag2 folder under their recorded names, at the recorded rate or R times as fast.
EOT
}

verb_main() {
  local bag=''
  local -a rest=()
  while (($#)); do
    case $1 in
      --rate | --set | --out)
        require_value "$@"
        rest+=("$1" "$2")
        shift
        ;;
      -*) rest+=("$1") ;;
      *)
        [[ -z $bag ]] || fail "one bag at a time: '$bag' or '$1'?" 2
        bag=$1
        ;;
    esac
    shift
  done
  [[ -n $bag ]] || fail "which bag? (panvo play --help)" 2
  [[ -e $bag ]] || fail "there is no bag '$bag'"
  start_program panvo_run "$(system_file play)" --bag "$bag" "${rest[@]}"
}
