# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Layouts of data sets that the data set player reads.

dataset_layouts() {
  cat <<'EOT'
A recording is a folder in one of these layouts:
  KITTI odometry   image_0/*.png image_1/*.png calib.txt; ground truth: poses.txt
  EuRoC/ASL        mav0/cam0/{data.csv,sensor.yaml,data/} mav0/cam1/...; ground truth: mav0/state_groundtruth_estimate0
  left and right   left/ and right/ images (or leftNNN, rightNNN in one folder) and a stereo calibration

`panvo data` lists public recordings, unpacks and checks downloads. Then run:
  panvo demo --dataset FOLDER
For the tests, put recordings into one folder and set PANVO_DATA=FOLDER.
EOT
}

# dataset_kind DIR: kitti, euroc or folders; prints nothing for another layout.
dataset_kind() {
  if [[ -d $1/image_0 && -d $1/image_1 && -f $1/calib.txt ]]; then
    echo kitti
  elif [[ -d $1/mav0/cam0 && -d $1/mav0/cam1 ]]; then
    echo euroc
  elif [[ -f $1/stereo_params.xml || -f $1/calibration.yaml ]] || [[ -d $1/left && -d $1/right ]]; then
    echo folders
  fi
}

# dataset_ground_truth DIR: the ground truth argument for `panvo evaluate`, or nothing.
dataset_ground_truth() {
  if [[ -f $1/poses.txt || -d $1/mav0/state_groundtruth_estimate0 ]]; then printf '%s' "$1"; fi
}
