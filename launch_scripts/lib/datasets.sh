# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Layouts of data sets that the data set player reads.

dataset_layouts() {
  cat <<'EOT'
A recording is a folder in one of these layouts:
  KITTI odometry   image_0/*.png image_1/*.png (or image_2, image_3) calib.txt; ground truth: poses.txt, or poses/NN.txt one or two
                   levels up
  EuRoC/ASL        mav0/cam0/{data.csv,sensor.yaml,data/} mav0/cam1/...; ground truth: mav0/state_groundtruth_estimate0, vicon0 or mocap0
  left and right   left/ and right/ images and a stereo calibration

`panvo data` lists public recordings, unpacks and checks downloads. Then run:
  panvo demo --dataset FOLDER
For the tests, put recordings into one folder and set PANVO_DATA=FOLDER.
EOT
}

# euroc_root DIR: mav0 of a EuRoC/ASL data set, which may be DIR itself.
euroc_root() { if [[ -d $1/mav0 ]]; then printf '%s/mav0' "$1"; else printf '%s' "$1"; fi; }

# dataset_kind DIR: kitti, euroc or folders, if DIR has a stereo pair in that layout; prints nothing otherwise.
dataset_kind() {
  local root
  root=$(euroc_root "$1")
  if [[ -f $root/cam0/data.csv && -f $root/cam1/data.csv ]]; then
    echo euroc
  elif [[ -f $1/calib.txt ]] && { [[ -d $1/image_0 && -d $1/image_1 ]] || [[ -d $1/image_2 && -d $1/image_3 ]]; }; then
    echo kitti
  elif [[ -d $1/left && -d $1/right ]]; then
    echo folders
  fi
}

# dataset_panorama DIR: the folder of the panorama camera, or nothing.
dataset_panorama() {
  local camera
  camera=$(euroc_root "$1")/cam2
  if grep -qs '^camera_model: *equirectangular' "$camera/sensor.yaml"; then printf '%s' "$camera"; fi
}

# dataset_ground_truth DIR: the ground truth argument for `panvo evaluate`, or nothing.
dataset_ground_truth() {
  local root folder name file
  root=$(euroc_root "$1")
  folder=$(readlink -f -- "$1")
  name=$(basename -- "$folder").txt
  for file in "$root"/{state_groundtruth_estimate0,vicon0,mocap0}/data.csv "$folder"/{poses.txt,"../poses/$name","../../poses/$name"}; do
    if [[ -f $file ]]; then
      printf '%s' "$1"
      return
    fi
  done
}
