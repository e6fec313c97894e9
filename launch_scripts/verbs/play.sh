# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: publish the messages of a bag

source "$PANVO_SCRIPTS/lib/build.sh"
source "$PANVO_SCRIPTS/lib/systems.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo play BAG [TOPIC...] [--rate R] [--start-paused] [--exclude TOPIC] [option of panvo run ...]

Publishes the messages of BAG (a rosbag2 folder, or one .db3 or .mcap file) under the recorded topic names. TOPIC is a name or a
regular expression that must match the whole name; default: all topics. The services of rosbag2's player control it:
/rosbag2_player/pause, resume, toggle_paused, is_paused, seek, get_rate, set_rate (refused at rate 0).

  --rate R          play at R times the recorded speed (default 0: as fast as possible)
  --start-paused    play nothing before /rosbag2_player/resume is called
  --exclude TOPIC   do not play this topic
EOT
}

verb_main() {
  local bag='' topics='' exclude=''
  local handed
  local -a handed_on=()
  while (($#)); do
    case $1 in
      --exclude)
        require_value "$@"
        exclude+="${exclude:+ }$2"
        shift
        ;;
      --start-paused) handed_on+=(start_paused:=true) ;;
      -* | *:=*)
        hand_on "$@"
        shift $((handed - 1))
        ;;
      *) if [[ -z $bag ]]; then bag=$1; else topics+="${topics:+ }$1"; fi ;;
    esac
    shift
  done
  [[ -n $bag ]] || fail "name a bag (panvo play --help)" 2
  [[ -e $bag ]] || fail "bag '$bag' not found"
  local system
  system=$(system_file play)
  start_program panvo_run "$system" "bag:=$bag" "topics:=$topics" "exclude:=$exclude" "${handed_on[@]}"
}
