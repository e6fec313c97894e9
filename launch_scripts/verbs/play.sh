# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: play a bag onto the network

source "$PANVO_SCRIPTS/lib/build.sh"
source "$PANVO_SCRIPTS/lib/systems.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo play BAG [TOPIC...] [--rate R] [--exclude TOPIC] [option of panvo run ...]

Publishes what the rosbag2 folder BAG holds (or one .db3 or .mcap file), under the recorded names. TOPIC is a name or a regular
expression for whole names; without one, everything is played.

  --rate R          R times as fast as recorded; 0: as fast as it goes
  --exclude TOPIC   not this one
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
  [[ -n $bag ]] || fail "which bag? (panvo play --help)" 2
  [[ -e $bag ]] || fail "there is no bag '$bag'"
  local system
  system=$(system_file play)
  start_program panvo_run "$system" "bag:=$bag" "topics:=$topics" "exclude:=$exclude" "${rest[@]}"
}
