// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

namespace panvo::landmarks {

/// Levels the panoramas of a camera that is mounted at a tilt. Landmarks are recognised at any heading only where a
/// turn of the vehicle shifts the panorama's columns, that is in an upright panorama.
class PanoramaLevel {
 public:
  PanoramaLevel() : PanoramaLevel(Eigen::Isometry3d::Identity(), false) {}
  /// Panoramas stay as they are up to 2 degrees of tilt, and from 60 to 120, where the transform has other axes than
  /// those of an optical frame. Beyond, the camera hangs upside down.
  explicit PanoramaLevel(const Eigen::Isometry3d& base_from_panorama);

  bool is_tilted() const noexcept { return is_tilted_; }
  /// Of the camera as it is.
  const Eigen::Isometry3d& base_from_panorama() const noexcept { return base_from_panorama_; }
  /// Of the levelled panorama: an upright camera at the same place, looking in the same direction.
  const Eigen::Isometry3d& base_from_level() const noexcept { return base_from_level_; }
  Eigen::Matrix3d panorama_from_level() const;

  /// The levelled panorama, of the same size and type; the same pixels if the camera is not tilted.
  cv::Mat level(const cv::Mat& panorama);
  /// The same for a mask, whose values are not mixed.
  cv::Mat level_mask(const cv::Mat& mask);

 private:
  PanoramaLevel(const Eigen::Isometry3d& base_from_panorama, bool is_tilted);
  cv::Mat levelled(const cv::Mat& panorama, int interpolation);

  Eigen::Isometry3d base_from_panorama_, base_from_level_;
  bool is_tilted_;
  cv::Mat columns_, rows_;  // where each pixel of the levelled panorama lies, for the last size
};

}  // namespace panvo::landmarks
