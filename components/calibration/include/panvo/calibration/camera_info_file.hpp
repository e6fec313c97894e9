// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <utility>

#include "panvo/vision/lens.hpp"

namespace panvo::calibration {

/// Content of a ROS camera_info file, one for each camera.
struct CameraInfo {
  std::string name;
  vision::LensCamera lens;
  Eigen::Matrix3d rectified_from_raw = Eigen::Matrix3d::Identity();              ///< R
  Eigen::Matrix<double, 3, 4> projection = Eigen::Matrix<double, 3, 4>::Zero();  ///< P; P(0, 3) = -fx * baseline (px m)
};

/// CameraInfo of a single camera: R is the identity, P is the camera matrix.
CameraInfo single_camera_info(const std::string& name, const vision::LensCamera& lens);

/// CameraInfos of a rectified pair, named `left` and `right`.
std::pair<CameraInfo, CameraInfo> stereo_camera_infos(const vision::LensCamera& left, const vision::LensCamera& right,
                                                      const vision::RectifiedStereo& pair);

/// The rectified pair described by two CameraInfos. Throws CalibrationError that names `folder` if they are not a pair:
/// no baseline, different projection matrices.
vision::RectifiedStereo rectified_pair(const CameraInfo& left, const CameraInfo& right,
                                       const std::filesystem::path& folder);

/// Both throw CalibrationError, on reading with file, line and key. Missing R or P are read as those of a single
/// camera.
CameraInfo read_camera_info(const std::filesystem::path& file);
void write_camera_info(const std::filesystem::path& file, const CameraInfo& info);

/// Replaces a file atomically. Throws CalibrationError.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace panvo::calibration
