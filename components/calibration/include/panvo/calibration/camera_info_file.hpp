// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <utility>

#include "panvo/vision/lens.hpp"

namespace panvo::calibration {

/// A calibration as ROS keeps it, one file a camera.
struct CameraInfo {
  std::string name;
  vision::LensCamera lens;
  Eigen::Matrix3d rectified_from_raw = Eigen::Matrix3d::Identity();  ///< R
  Eigen::Matrix<double, 3, 4> projection =
      Eigen::Matrix<double, 3, 4>::Zero();  ///< P; first row's last: -fx * baseline (px m)
};

/// Of a camera by itself: R the identity, P the raw image's own matrix.
CameraInfo single_camera_info(const std::string& name, const vision::LensCamera& lens);

/// Of a pair, named `left` and `right`.
std::pair<CameraInfo, CameraInfo> stereo_camera_infos(const vision::LensCamera& left, const vision::LensCamera& right,
                                                      const vision::RectifiedStereo& pair);

/// The rectified pair that two calibrations describe. Throws CalibrationError, naming `folder`, where they are none: no baseline, matrices that
/// differ.
vision::RectifiedStereo rectified_pair(const CameraInfo& left, const CameraInfo& right,
                                       const std::filesystem::path& folder);

/// Both throw CalibrationError, naming file, line and key. A file without rectification or projection reads as of a single camera.
CameraInfo read_camera_info(const std::filesystem::path& file);
void write_camera_info(const std::filesystem::path& file, const CameraInfo& info);

/// Writes a text whole or not at all. Throws CalibrationError.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace panvo::calibration
