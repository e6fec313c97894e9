# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# System files, given by path or by name in config/systems.

list_systems() {
  local file
  for file in "$PANVO_HOME"/config/systems/*.yaml; do
    [[ -e $file ]] && basename "$file" .yaml
  done | xargs
}

# system_file NAME_OR_PATH
system_file() {
  local named=$PANVO_HOME/config/systems/${1%.yaml}.yaml
  local -a known
  if [[ -f $1 ]]; then
    printf '%s' "$1"
  elif [[ $1 != */* && -f $named ]]; then
    printf '%s' "$named"
  elif [[ $1 == */* || $1 == *.yaml ]]; then
    fail "system file '$1' not found (systems in config/systems: $(list_systems))"
  else
    read -r -a known <<<"$(list_systems)"
    fail "unknown system '$1'; did you mean '$(nearest_word "$1" "${known[@]}")'? (available: ${known[*]})" 2
  fi
}

# run_to_its_end OUT ARGUMENT...: runs a system with its results in OUT; fails if the run fails or is interrupted.
run_to_its_end() {
  local out=$1 status=0
  shift
  "$(program panvo_run)" "$@" --out "$out" || status=$?
  case $status in
    0) ;;
    2) fail "the run was refused, see above" 2 ;;
    130 | 143) fail "interrupted; the results up to then are in $out" "$status" ;;
    *) fail "the run failed; its log is $out/run.log" ;;
  esac
}

# takes_value OPTION: whether this option of panvo_run takes a value.
takes_value() {
  case $1 in
    --dataset | --bag | --calibration | --out | --rate | --set | --seed | --domain | --dds-profiles | --container | --await | --respawn-delay | --secure | --enclave | --ros-distro | -p | --param | -r | --remap) return 0 ;;
    *) return 1 ;;
  esac
}

# hand_on ARGUMENT...: adds the first argument, an option of panvo_run or NAME:=VALUE, to the array `handed_on`, with its value if it has
# one. Sets `handed`, the number of these words.
hand_on() {
  handed=1
  handed_on+=("$1")
  takes_value "$1" || return 0
  require_value "$@"
  handed_on+=("$2")
  handed=2
}

# resolve_system ARGUMENT...: sets resolved_arguments, the arguments for panvo_run. The first argument that is not an option is the system.
resolve_system() {
  local system='' handed
  local -a handed_on=()
  while (($#)); do
    handed=1
    if [[ -z $system && $1 != -* ]]; then
      system=$(system_file "$1")
      handed_on+=("$system")
    else
      hand_on "$@"
    fi
    shift "$handed"
  done
  [[ -n $system ]] || fail "name a system; available: $(list_systems) (panvo run --help)" 2
  # shellcheck disable=SC2034 # for the caller
  resolved_arguments=("${handed_on[@]}")
}
