# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: calibrate stereo pairs, rigs and extrinsics from board images or live topics; check and convert calibrations

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo calibrate board --board BOARD --out board.svg            draw a board for printing
       panvo calibrate images BAG --out IMAGES                        extract images from a bag, one pair per second
       panvo calibrate stereo IMAGES --board BOARD --out RIG          intrinsics, extrinsics and rectification of a stereo pair
       panvo calibrate stereo --topics LEFT RIGHT --board BOARD --out RIG   the same from live topics; also for rig and extrinsics
       panvo calibrate rig IMAGES --board BOARD --out RIG             intrinsics and poses of the heads of a rig
       panvo calibrate extrinsics IMAGES --calibration RIG --board BOARD --out RIG   only the poses of calibrated cameras
       panvo calibrate check IMAGES --calibration RIG --board BOARD   check whether a stereo calibration is still valid
       panvo calibrate convert CAMCHAIN.yaml --out RIG                import from Kalibr; or RIG --out CAMCHAIN.yaml to export

BOARD is chessboard:9x6:0.025 (inner corners, square side in m) or charuco:10x7:0.03:0.022:DICT_5X5_100 (squares, sides of square
and marker in m). RIG is a folder of ROS camera_info files; config/rigs holds examples. Each command has its own --help.
EOT
  show_program_help panvo_calibrate
}

verb_main() {
  if [[ ${1:-} == images ]]; then
    shift
    start_program panvo_calibration_images "$@"
  else
    start_program panvo_calibrate "$@"
  fi
}
