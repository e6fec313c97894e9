// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "panvo/dataset_player/dataset.hpp"

/// Ground truth of data sets. The images and calibrations need not exist. All readers throw DatasetError (file, line).
namespace panvo::dataset_player {

/// File with the ground truth of the data set in `directory`; nullopt if it has none. EuRoC/ASL: data.csv of
/// state_groundtruth_estimate0, else vicon0, else mocap0, in mav0 or `directory`. KITTI: poses.txt, else poses/NN.txt
/// one or two levels up, where NN is the name of `directory`.
std::optional<std::filesystem::path> find_ground_truth(const std::filesystem::path& directory);

/// EuRoC/ASL: each line holds stamp, position and quaternion (w x y z) of a sensor. T_BS of a sensor.yaml beside the file
/// is the pose of that sensor on the vehicle; without it the poses are those of the vehicle. May be empty.
std::vector<GroundTruthPose> read_euroc_poses(const std::filesystem::path& file);

/// KITTI: each line holds the rows of a 3 x 4 matrix, the pose of camera 0 (x right, y down) in its first pose. Both
/// frames are converted to vehicle axes (x forward, y left, z up). May be empty.
std::vector<Eigen::Isometry3d> read_kitti_poses(const std::filesystem::path& file);

/// KITTI: the time of each image and pose, s, one per line, increasing; returned in ns.
std::vector<std::int64_t> read_kitti_times(const std::filesystem::path& file);

/// The times.txt that belongs to a file of KITTI poses: beside it or, for poses/NN.txt, in NN or sequences/NN beside the
/// folder poses.
std::optional<std::filesystem::path> find_kitti_times(const std::filesystem::path& poses);

}  // namespace panvo::dataset_player
