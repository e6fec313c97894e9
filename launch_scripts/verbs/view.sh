# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: show live topics, or a bag, in a browser and in Foxglove

source "$PANVO_SCRIPTS/lib/build.sh"
source "$PANVO_SCRIPTS/lib/systems.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo view [--bag BAG] [--port P] [--host HOST --token TOKEN] [--tls-certificate FILE --tls-key FILE] [--allow-control]
                  [option of panvo run ...]

Shows all topics of the DDS domain in a browser, http://127.0.0.1:8765, and to Foxglove, Lichtblick and others, until Ctrl-C. There:
"Open connection", "Foxglove WebSocket", ws://127.0.0.1:8765.

  --bag BAG          also play BAG (a rosbag2 folder, or one .db3 or .mcap file) at recorded speed; --rate R: at R times. The view stays
                     open at the end. Services pause it, move it and change its speed: `panvo service list` shows /rosbag2_player/...
  --port P           TCP port (8765)
  --host HOST        address to listen on (127.0.0.1); 0.0.0.0: all networks of this machine
  --token TOKEN      secret of the address: http://HOST:PORT/?token=TOKEN; needed if HOST is not local
  --tls-certificate FILE, --tls-key FILE
                     encrypt connections, https://HOST:PORT and wss://HOST:PORT, with a certificate and its key in PEM format
  --allow-control    viewers may publish, such as /initialpose, set parameters and call services, such as those of the player

A certificate that viewers must be told to trust, such as by the question that a browser asks once:

  openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -days 365 -subj /CN=HOST \
    -addext subjectAltName=DNS:HOST -keyout key.pem -out cert.pem    # for an address: subjectAltName=IP:ADDRESS
EOT
}

verb_main() {
  local bag='' port=8765 host=127.0.0.1 token='' secure='' system=view
  local handed
  local -a handed_on=() rate=()
  while (($#)); do
    case $1 in
      --bag | --port | --host | --token)
        require_value "$@"
        printf -v "${1#--}" '%s' "$2"
        shift
        ;;
      --tls-certificate | --tls-key)
        require_value "$@"
        handed=${1#--}
        handed_on+=("${handed//-/_}:=$(realpath -m -- "$2")")
        secure=s
        shift
        ;;
      --bag=* | --port=* | --host=* | --token=* | --tls-certificate=* | --tls-key=* | --rate=*)
        set -- "${1%%=*}" "${1#*=}" "${@:2}"
        continue
        ;;
      --allow-control) handed_on+=(allow_control:=true) ;;
      -* | *:=*)
        hand_on "$@"
        shift $((handed - 1))
        ;;
      *) fail "unexpected argument '$1'; a bag is named by --bag (panvo view --help)" 2 ;;
    esac
    shift
  done
  if [[ -n $bag ]]; then
    [[ -e $bag ]] || fail "bag '$bag' not found"
    system=view_bag
    handed_on+=("bag:=$bag")
    [[ " ${handed_on[*]} " == *" --rate "* ]] || rate=(--rate 1)
  fi
  note "open http$secure://$host:$port${token:+/?token=TOKEN} in a browser, or ws$secure://$host:$port${token:+?token=TOKEN} in Foxglove; Ctrl-C ends"
  start_program panvo_run "$(system_file "$system")" "host:=$host" "port:=$port" "token:=$token" "${rate[@]}" "${handed_on[@]}"
}
