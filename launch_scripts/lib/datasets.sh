# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Recordings by their layout, as the data set player reads them; and which one the demo takes.

dataset_layouts() {
  cat <<'EOT'
Recordings are folders in one of these layouts:
  KITTI odometry   image_0/*.png image_1/*.png calib.txt, and poses.txt when there is ground truth
  EuRoC/ASL        mav0/cam0/{data.csv,sensor.yaml,data/} mav0/cam1/..., ground truth in mav0/state_groundtruth_estimate0
  left and right   left/ and right/ images (or leftNNN, rightNNN in one folder) with a stereo calibration beside them

Get one, for example sequence 03 of KITTI odometry (grey images, calibration and poses) or a EuRoC MAV sequence, then:
  panvo demo --dataset FOLDER
or put several into one folder and name it once: export PANVO_DATA=FOLDER
EOT
}

# dataset_kind DIR: kitti, euroc or folders; nothing when DIR is none of them.
dataset_kind() {
  if [[ -d $1/image_0 && -d $1/image_1 && -f $1/calib.txt ]]; then
    echo kitti
  elif [[ -d $1/mav0/cam0 && -d $1/mav0/cam1 ]]; then
    echo euroc
  elif [[ -f $1/stereo_params.xml || -f $1/calibration.yaml ]] || [[ -d $1/left && -d $1/right ]]; then
    echo folders
  fi
}

# dataset_ground_truth DIR: what `panvo evaluate` takes as ground truth, or nothing.
dataset_ground_truth() {
  if [[ -f $1/poses.txt || -d $1/mav0/state_groundtruth_estimate0 ]]; then printf '%s' "$1"; fi
}
