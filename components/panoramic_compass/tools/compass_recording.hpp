// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <vector>

/// An EuRoC/ASL data set as far as the compass needs it: cam2 and ground truth.
namespace panvo::panoramic_compass {

struct RecordedPanorama {
  std::int64_t stamp_ns = 0;
  std::filesystem::path image;
  Eigen::Quaterniond map_from_base = Eigen::Quaterniond::Identity();  ///< true, interpolated
};

struct CompassRecording {
  Eigen::Matrix3d base_from_panorama = Eigen::Matrix3d::Identity();
  std::vector<RecordedPanorama> panoramas;  ///< stamps increase; those that the ground truth covers
};

/// `late_ns`: how much later than its stamp a panorama was taken. Throws std::runtime_error naming what is wrong.
CompassRecording read_compass_recording(const std::filesystem::path& directory, std::int64_t late_ns = 0);

/// Yaw of the vehicle at `now` minus at `then`, about its upward axis then.
double true_change_rad(const RecordedPanorama& then, const RecordedPanorama& now);

}  // namespace panvo::panoramic_compass
