# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: run a system file: live, on a data set or on a bag

source "$PANVO_SCRIPTS/lib/build.sh"
source "$PANVO_SCRIPTS/lib/systems.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo run SYSTEM [--dataset DIR | --bag DIR] [--out DIR] [--replay | --rate R] [--set C.P=V ...] [NAME:=VALUE ...]

SYSTEM is a system file, or the name of one in config/systems: `panvo run stereo`.

  --dataset DIR   play a data set (KITTI, EuRoC/ASL, or left/right folders with a calibration)
  --bag BAG       play a recorded bag: a rosbag2 folder, or one .db3 or .mcap file
  --out DIR       leave trajectory, times and summary there: a new folder, or one of an earlier run (--overwrite: any)
  --replay        deterministic: one thread, in order of stamps, as fast as it goes
  --rate R        play at R times the recorded rate (default 0: as fast as the components take it)
  --set C.P=V     set parameter P of component C (panvo component show lists them)
  --container C   only this container of the system: the others run elsewhere
  --await T[:N]   begin when N other processes read or write topic T
  --respawn       start a container again that crashed (--respawn-delay S)
  --secure DIR    with the keys of a keystore (panvo secure)
  NAME:=VALUE     give an argument that the system file declares

EOT
  printf 'Systems here: %s\n' "$(list_systems)"
}

verb_main() {
  resolve_system "$@"
  start_program panvo_run "${resolved_arguments[@]}"
}
