# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: render a drive through the simulated campus into a data set or a bag

source "$PANVO_SCRIPTS/lib/build.sh"
source "$PANVO_SCRIPTS/lib/routes.sh"
source "$PANVO_SCRIPTS/lib/supervise.sh"
source "$PANVO_SCRIPTS/lib/systems.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo simulate ROUTE --out DIR [--bag] [--seed N] [--effects LIST] [option ...]
       panvo simulate ROUTE --out DIR --pictures 0,5.2,30       single views as PNG, at these times in s
       panvo simulate ROUTE --out DIR --map                     campus map with the route as PNG
       panvo simulate --junctions gate,library,... --out DIR    route through these junctions
       panvo simulate --random 12 --seed 7 --out DIR            random route over 12 junctions

Renders the images of a vehicle's stereo and panoramic cameras along a route, with exact ground truth, as a EuRoC/ASL data set
or, with --bag, as a bag. The same arguments give the same pixels.

EOT
  printf 'ROUTE is the path of a route file, or the name of one in config/routes:\n'
  describe_routes
  show_program_help panvo_simulate
}

verb_main() {
  local route='' as_bag=no
  local -a rest=()
  while (($#)); do
    case $1 in
      --bag) as_bag=yes ;;
      --truth-only | --map | --night | --overcast | --wet) rest+=("$1") ;;
      -*=*) rest+=("${1%%=*}" "${1#*=}") ;;
      -*)
        require_value "$@"
        rest+=("$1" "$2")
        shift
        ;;
      *)
        [[ -z $route ]] || fail "only one route is allowed: '$route' or '$1'?" 2
        route=$(route_file "$1")
        ;;
    esac
    shift
  done
  [[ -z $route ]] || rest=(--route "$route" "${rest[@]}")
  if [[ $as_bag == yes ]]; then supervise simulate_bag "${rest[@]}"; else start_program panvo_simulate "${rest[@]}"; fi
}

# simulate_bag OPTION VALUE ...: plays the drive with the simulation component, records it, and writes ground truth beside the bag.
simulate_bag() {
  local out='' name run simulate
  local -a parameters=() given=("$@")
  while (($#)); do
    name=${1#--}
    case $name in
      out) out=$2 ;;
      route | rig | assets) parameters+=(--set "simulation.$name=$(readlink -m -- "$2")") ;;
      night | overcast | wet)
        parameters+=(--set "simulation.$name=true")
        shift
        continue
        ;;
      seed | hilliness | hour | season | vibration | cameras) parameters+=(--set "simulation.$name=$2") ;;
      calibration-error) parameters+=(--set "simulation.calibration_error=$2") ;;
      start | duration) parameters+=(--set "simulation.${name}_s=$2") ;;
      random) parameters+=(--set "simulation.random_junctions=$2") ;;
      effects | junctions) parameters+=(--set "simulation.$name=[$2]") ;;
      *) fail "$1 cannot be combined with --bag (panvo simulate --help)" 2 ;;
    esac
    shift 2
  done
  [[ -n $out ]] || fail "name a new folder with --out" 2
  [[ ! -e $out || -z $(ls -A -- "$out" 2>/dev/null || echo no) ]] || fail "'$out' exists and is not empty; choose a new folder"
  use_built panvo_run panvo_simulate
  use_plugins
  run=$(program panvo_run)
  simulate=$(program panvo_simulate)
  # Ground truth first: it rejects invalid arguments immediately.
  "$simulate" "${given[@]}" --truth-only || exit 1
  "$run" "$(system_file simulate_bag)" --replay "bag:=$out/bag" "${parameters[@]}" || fail "the run failed; the messages above say why"
  note "bag: $out/bag, ground truth: $out/sequence.yaml"
}
