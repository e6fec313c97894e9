# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: show live topics, or a bag, in Foxglove

source "$PANVO_SCRIPTS/lib/build.sh"
source "$PANVO_SCRIPTS/lib/systems.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo view [--bag BAG] [--port P] [--host HOST --token TOKEN] [--allow-control] [option of panvo run ...]

Serves all topics of the DDS domain to Foxglove, Lichtblick and others, until Ctrl-C. In the viewer: "Open connection", "Foxglove
WebSocket", ws://127.0.0.1:8765.

  --bag BAG          also play BAG (a rosbag2 folder, or one .db3 or .mcap file), once, at recorded speed; --rate R: at R times
  --port P           TCP port (8765)
  --host HOST        address to listen on (127.0.0.1); 0.0.0.0: all networks of this machine
  --token TOKEN      secret of the address: ws://HOST:PORT?token=TOKEN; needed if HOST is not local
  --allow-control    viewers may publish, such as /initialpose
EOT
}

verb_main() {
  local bag='' port=8765 host=127.0.0.1 token='' system=view
  local -a rest=() rate=()
  while (($#)); do
    case $1 in
      --bag | --port | --host | --token)
        require_value "$@"
        printf -v "${1#--}" '%s' "$2"
        shift
        ;;
      --allow-control) rest+=(allow_control:=true) ;;
      -* | *:=*)
        rest+=("$1")
        if takes_value "$1"; then
          require_value "$@"
          rest+=("$2")
          shift
        fi
        ;;
      *) fail "unexpected argument '$1'; a bag is named by --bag (panvo view --help)" 2 ;;
    esac
    shift
  done
  if [[ -n $bag ]]; then
    [[ -e $bag ]] || fail "bag '$bag' not found"
    system=view_bag
    rest+=("bag:=$bag")
    [[ " ${rest[*]} " == *" --rate "* ]] || rate=(--rate 1)
  fi
  note "open ws://$host:$port${token:+?token=TOKEN} in Foxglove or Lichtblick (Open connection, Foxglove WebSocket); Ctrl-C ends"
  start_program panvo_run "$(system_file "$system")" "host:=$host" "port:=$port" "token:=$token" "${rate[@]}" "${rest[@]}"
}
