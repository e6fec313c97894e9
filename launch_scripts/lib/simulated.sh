# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Simulated drives, rendered once and cached.

source "$PANVO_SCRIPTS/lib/routes.sh"

# simulated_dataset ROUTE SEED EFFECTS: path of the data set of a simulated drive.
simulated_dataset() {
  local name route
  # A good stereo calibration that has aged for months; with an exact one, odometry hardly drifts.
  local -a options=(--calibration-error 1)
  route=$(route_file "$1")
  name=$(basename "$route" .yaml)
  if [[ $3 != none ]]; then
    name+=-$3
    options+=(--effects "$3")
  fi
  rendered_dataset "$name-seed$2" --route "$route" "${options[@]}" --seed "$2"
}

# simulated_panoramas ROUTE SEED: path of the data set of a simulated drive without stereo images.
simulated_panoramas() {
  local route
  route=$(route_file "$1")
  rendered_dataset "$(basename "$route" .yaml)-panoramas-seed$2" --route "$route" --cameras panorama --seed "$2"
}

# rendered_dataset NAME OPTION...: path of what panvo_simulate renders with these options; renders it if it is missing or incomplete. The
# folder's name contains a hash of simulator, options and their files; data sets of other simulator versions are deleted.
rendered_dataset() {
  local name=$1 simulate folder key dataset option
  shift
  simulate=$(program panvo_simulate)
  folder=${XDG_CACHE_HOME:-$HOME/.cache}/panvo/simulated
  ! in_checkout || folder=$PANVO_HOME/runs/simulated
  key=$({
    mapfile -t libraries < <(simulation_libraries "$simulate")
    cat "$simulate" "${libraries[@]}"
    for option; do if [[ -f $option ]]; then cat "$option"; else echo "$option"; fi; done
  } | sha256sum | cut -c 1-12)
  dataset=$folder/$name-$key
  if [[ ! -f $dataset/sequence.yaml ]]; then
    mkdir -p -- "$folder" || fail "cannot create '$folder'; name a recording with --dataset"
    find "$folder" -maxdepth 1 -name "$name-*" ! -name "*-$key*" -exec rm -rf {} +
    note "simulating the drive '$name' into $dataset"
    "$simulate" "$@" --out "$dataset" >&2 || fail "the simulation failed, see the message above"
  fi
  printf '%s' "$dataset"
}

# simulation_libraries PROGRAM: paths of the libraries of the simulation that the program is linked with, one per line.
simulation_libraries() { ldd "$1" | sed -nE 's/.*libpanvo_simulat(ion|ed_world)[^ ]* => (.*) \(0x[0-9a-f]+\)$/\2/p' | sort; }
