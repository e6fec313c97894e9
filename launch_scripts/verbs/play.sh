# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: publish the messages of a bag

source "$PANVO_SCRIPTS/lib/build.sh"
source "$PANVO_SCRIPTS/lib/systems.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo play BAG [TOPIC...] [--rate R] [--exclude TOPIC] [option of panvo run ...]

Publishes the messages of BAG (a rosbag2 folder, or one .db3 or .mcap file) under the recorded topic names. TOPIC is a name or a
regular expression that must match the whole name; default: all topics.

  --rate R          play at R times the recorded speed; 0: as fast as possible
  --exclude TOPIC   do not play this topic
EOT
}

verb_main() {
  local bag='' topics='' exclude=''
  local -a rest=()
  while (($#)); do
    case $1 in
      --exclude)
        require_value "$@"
        exclude+="${exclude:+ }$2"
        shift
        ;;
      -* | *:=*)
        rest+=("$1")
        if takes_value "$1"; then
          require_value "$@"
          rest+=("$2")
          shift
        fi
        ;;
      *) if [[ -z $bag ]]; then bag=$1; else topics+="${topics:+ }$1"; fi ;;
    esac
    shift
  done
  [[ -n $bag ]] || fail "name a bag (panvo play --help)" 2
  [[ -e $bag ]] || fail "bag '$bag' not found"
  local system
  system=$(system_file play)
  start_program panvo_run "$system" "bag:=$bag" "topics:=$topics" "exclude:=$exclude" "${rest[@]}"
}
