# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: run a system: live, on a data set or on a bag

source "$PANVO_SCRIPTS/lib/build.sh"
source "$PANVO_SCRIPTS/lib/systems.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo run SYSTEM [--dataset DIR | --bag BAG] [--out DIR] [--replay | --rate R] [--set C.P=V ...] [NAME:=VALUE ...]

SYSTEM is a system file, or the name of one in config/systems: `panvo run stereo`.

  --dataset DIR        play a data set (KITTI, EuRoC/ASL, or left/right folders with a calibration)
  --bag BAG            play a bag: a rosbag2 folder, or one .db3 or .mcap file
  --calibration DIR    calibration of stereo images without camera_info: a folder with left.yaml and right.yaml
  --view               also show all topics in a browser and in Foxglove (http://127.0.0.1:8765)
  --out DIR            write trajectory, times and summary to DIR: a new folder, or one of an earlier run (--overwrite: any)
  --replay             deterministic: one thread, in stamp order, as fast as possible
  --rate R             play at R times the recorded speed (default 0: as fast as the components can process)
  --set C.P=V          set parameter P of component C (panvo component show lists them)
  -p, --param P:=V     as in ROS 2: set parameter P of all nodes; NODE:P:=V: of one node
  -r, --remap A:=B     as in ROS 2: use topic B for A in all nodes; NODE:A:=B: in one node; __ns:=/NS: namespace of all nodes;
                       __node:=NAME: name of the container
  --describe           print the topics and nodes of each container and exit
  --container C        start only this container of the system; the others run elsewhere
  --await T[:N]        wait until N other processes (default 1) are connected to topic T
  --respawn            restart crashed containers (after --respawn-delay S)
  --local              stay within this process: no DDS
  --domain N           DDS domain (default: ROS_DOMAIN_ID, else 0)
  --ros-distro NAME    ROS 2 distribution of other nodes: humble, or jazzy for all later ones (default: ROS_DISTRO, else jazzy)
  --dds-profiles FILE  Fast DDS XML profiles, as in config/dds
  --secure DIR         use the keys of this keystore (panvo secure)
  --enclave NAME       with --secure: use this enclave of the keystore (default: each container's own, or /panvo)
  --seed N             seed that components get from Context::seed() (default 1); the components of panvo have seed parameters
  --verbose            also show debug messages
  NAME:=VALUE          set an argument declared by the system file

EOT
  printf 'Systems: %s\n' "$(list_systems)"
}

verb_main() {
  resolve_system "$@"
  start_program panvo_run "${resolved_arguments[@]}"
}
