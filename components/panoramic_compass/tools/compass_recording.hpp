// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <vector>

/// Reads panoramas (cam2) and ground truth of an EuRoC/ASL data set.
namespace panvo::panoramic_compass {

struct RecordedPanorama {
  std::int64_t stamp_ns = 0;
  std::filesystem::path image;
  Eigen::Quaterniond map_from_base = Eigen::Quaterniond::Identity();  ///< ground truth, interpolated
};

struct CompassRecording {
  Eigen::Matrix3d base_from_panorama = Eigen::Matrix3d::Identity();
  std::vector<RecordedPanorama> panoramas;  ///< covered by the ground truth, by increasing stamps
};

/// `late_ns`: delay of the exposure after the stamp. Throws std::runtime_error with the file and its problem.
CompassRecording read_compass_recording(const std::filesystem::path& directory, std::int64_t late_ns = 0);

/// Yaw of the vehicle at `now` minus that at `then`, about its upward axis at `then`.
double true_change_rad(const RecordedPanorama& then, const RecordedPanorama& now);

}  // namespace panvo::panoramic_compass
