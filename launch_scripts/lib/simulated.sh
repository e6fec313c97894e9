# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Journeys through the simulated campus that are rendered once and kept.

source "$PANVO_SCRIPTS/lib/routes.sh"

# simulated_dataset ROUTE SEED EFFECTS: the data set of a journey through the simulated campus, rendered when it is not there yet, or
# not wholly. It is named by what it was rendered with, and one that another panvo rendered makes room for it.
simulated_dataset() {
  local seed=$2 effects=$3 route simulate folder name key dataset
  # A good stereo calibration after months of driving; an exact one hardly drifts.
  local -a rig=(--calibration-error 1)
  route=$(route_file "$1")
  simulate=$(program panvo_simulate)
  folder=${XDG_CACHE_HOME:-$HOME/.cache}/panvo/simulated
  ! in_checkout || folder=$PANVO_HOME/runs/simulated
  name=$1-seed$seed
  if [[ $effects != none ]]; then
    name=$1-$effects-seed$seed
    rig+=(--effects "$effects")
  fi
  key=$({
    cat "$route" "$simulate" "$(simulation_library "$simulate")"
    echo "${rig[@]}"
  } | sha256sum | cut -c 1-12)
  dataset=$folder/$name-$key
  if [[ ! -f $dataset/sequence.yaml ]]; then
    mkdir -p -- "$folder" || fail "'$folder' cannot be made; name a recording with --dataset"
    find "$folder" -maxdepth 1 -name "$name-*" ! -name "*-$key*" -exec rm -rf {} +
    note "simulating the route '$1'; it is kept in $dataset"
    "$simulate" --route "$route" "${rig[@]}" --seed "$seed" --out "$dataset" >&2 || fail "the simulation failed; the message above says why"
  fi
  printf '%s' "$dataset"
}

# simulation_library PROGRAM: the library that the program renders with.
simulation_library() { ldd "$1" | sed -n 's/.*libpanvo_simulation[^ ]* => \([^ ]*\).*/\1/p'; }
