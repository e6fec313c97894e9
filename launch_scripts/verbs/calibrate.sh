# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: calibrate a stereo pair, a rig, or where cameras are, from images or live topics with a board; check and convert calibrations

source "$PANVO_SCRIPTS/lib/build.sh"

verb_usage() {
  cat <<'EOT'
usage: panvo calibrate board --board BOARD --out board.svg            print one
       panvo calibrate images BAG --out IMAGES                        the images of a bag, one pair a second
       panvo calibrate stereo IMAGES --board BOARD --out RIG          both lenses of a pair, and its rectification
       panvo calibrate stereo --topics LEFT RIGHT --board BOARD --out RIG   the same from cameras that run; rig, extrinsics too
       panvo calibrate rig IMAGES --board BOARD --out RIG             lenses and poses of the heads of a rig
       panvo calibrate extrinsics IMAGES --calibration RIG --board BOARD --out RIG   only where calibrated cameras are
       panvo calibrate check IMAGES --calibration RIG --board BOARD   whether a pair's calibration still holds
       panvo calibrate convert CAMCHAIN.yaml --out RIG                Kalibr's calibration; a RIG to CAMCHAIN.yaml, too

BOARD is chessboard:9x6:0.025 (corners inside, side of a square in m) or charuco:10x7:0.03:0.022:DICT_5X5_100 (squares, sides of square
and marker in m). RIG is a folder of ROS camera_info files, as config/rigs shows some. Each command has its own --help.
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
