// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "panvo/vision/camera.hpp"

namespace panvo::vision {

/// Look-up table from a raw image to its rectified one, in OpenCV's fixed-point form (CV_16SC2 and CV_16UC1).
class RectificationMap {
 public:
  /// Maps images of `raw` to images of `rectified`, whose frame is turned by `rectified_from_raw`.
  RectificationMap(const DistortedCamera& raw, const Eigen::Matrix3d& rectified_from_raw,
                   const PinholeCamera& rectified);

  /// Writes the rectified image into `destination` (allocated when size or type differ); any depth, 1 to 4 channels.
  /// Throws std::invalid_argument when the image is not of the raw camera's size.
  void apply(const cv::Mat& raw_image, cv::Mat& destination) const;

 private:
  cv::Size raw_size_;
  cv::Mat coordinates_;
  cv::Mat fractions_;
};

}  // namespace panvo::vision
