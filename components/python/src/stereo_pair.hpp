// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <opencv2/core.hpp>
#include <optional>
#include <utility>

#include "panvo/vision/rectification.hpp"
#include "panvo/vision/stereo_calibration.hpp"

namespace panvo::python {

/// A stereo camera as its images are stored, its rectification, and its place on the vehicle.
struct StereoPair {
  vision::StereoCalibration raw;
  vision::RectifiedStereo rectified;
  Eigen::Isometry3d base_from_left = Eigen::Isometry3d::Identity();  ///< of the raw left optical frame

  /// Whether the stored images are already rectified.
  bool is_rectified() const;
  /// Pose of the rectified left optical frame.
  Eigen::Isometry3d base_from_rectified_left() const;
};

/// Rectifies the images of a pair as grey, as StereoRectifierComponent does.
class StereoRectifier {
 public:
  /// Throws std::invalid_argument where vision::RectificationMap does.
  explicit StereoRectifier(const StereoPair& pair);

  /// The rectified grey images (CV_8UC1). Of grey images that are already rectified, these are the given ones.
  std::pair<cv::Mat, cv::Mat> rectify(const cv::Mat& left, const cv::Mat& right) const;

 private:
  std::array<std::optional<vision::RectificationMap>, 2> maps_;
};

}  // namespace panvo::python
