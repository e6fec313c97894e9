// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "panvo/calibration_files/file_error.hpp"
#include "panvo/vision/lens.hpp"

namespace panvo::calibration_files {

/// Content of a ROS camera_info file, which describes one camera. Matrices are in the order of the file.
struct CameraInfo {
  std::string name;
  int width = 0;                                                                         ///< px
  int height = 0;                                                                        ///< px
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> camera_matrix = Eigen::Matrix3d::Zero();  ///< K
  std::string distortion_model;  ///< as written in the file; vision::lens_camera() lists the names
  std::vector<double> distortion_coefficients;
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rectification_matrix = Eigen::Matrix3d::Identity();  ///< R, from raw
  /// P; P(0, 3) = -fx * baseline (px m).
  Eigen::Matrix<double, 3, 4, Eigen::RowMajor> projection_matrix = Eigen::Matrix<double, 3, 4>::Zero();

  std::filesystem::path file;  ///< it was read from; for messages
  std::string model_at;        ///< "left.yaml:9: distortion_model": location for errors about the lens

  /// The lens. Throws FileError if the model is unknown or does not fit the coefficients.
  vision::LensCamera lens() const;
};

/// CameraInfo of a single camera: R is the identity, P is the camera matrix.
CameraInfo single_camera_info(const std::string& name, const vision::LensCamera& lens);

enum class Rectification {
  kOptional,  ///< without R or P they are those of a single camera
  kRequired
};

/// Reads a file; without camera_name the name is that of the file. Any lens model is accepted, see CameraInfo::lens().
/// Throws FileError with all problems.
CameraInfo read_camera_info(const std::filesystem::path& file, Rectification rectification = Rectification::kOptional);

/// Replaces a file atomically. Throws FileError.
void write_camera_info(const std::filesystem::path& file, const CameraInfo& info);

}  // namespace panvo::calibration_files
