# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Simulated drives, rendered once and cached.

source "$PANVO_SCRIPTS/lib/routes.sh"

# simulated_dataset ROUTE SEED EFFECTS: path of the data set of a simulated drive; renders it if it is missing or incomplete. The name
# contains a hash of route, simulator and options; data sets of other simulator versions are deleted.
simulated_dataset() {
  local seed=$2 effects=$3 route simulate folder name key dataset
  # A good stereo calibration that has aged for months; with an exact one, odometry hardly drifts.
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
    mapfile -t libraries < <(simulation_libraries "$simulate")
    cat "$route" "$simulate" "${libraries[@]}"
    echo "${rig[@]}"
  } | sha256sum | cut -c 1-12)
  dataset=$folder/$name-$key
  if [[ ! -f $dataset/sequence.yaml ]]; then
    mkdir -p -- "$folder" || fail "cannot create '$folder'; name a recording with --dataset"
    find "$folder" -maxdepth 1 -name "$name-*" ! -name "*-$key*" -exec rm -rf {} +
    note "simulating the route '$1' into $dataset"
    "$simulate" --route "$route" "${rig[@]}" --seed "$seed" --out "$dataset" >&2 || fail "the simulation failed, see the message above"
  fi
  printf '%s' "$dataset"
}

# simulation_libraries PROGRAM: paths of the libraries of the simulation that the program is linked with, one per line.
simulation_libraries() { ldd "$1" | sed -nE 's/.*libpanvo_simulat(ion|ed_world)[^ ]* => ([^ ]*).*/\2/p' | sort; }
