// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "panvo/vision/camera.hpp"
#include "panvo/vision/lens.hpp"

namespace panvo::vision {

/// Look-up table from a raw image to its rectified one, in steps of 1/32 px as OpenCV's remap; the pixels are the same as its.
/// Images of 8 bits and 1 or 3 channels go through packed look-ups, others through remap itself.
class RectificationMap {
 public:
  /// Maps images of `raw` to images of `rectified`, whose frame is turned by `rectified_from_raw`. What a wide lens does not see is
  /// black. Throws std::invalid_argument where CameraModel does.
  RectificationMap(const LensCamera& raw, const Eigen::Matrix3d& rectified_from_raw, const PinholeCamera& rectified);

  /// Writes the rectified image into `destination` (allocated when size or type differ); any depth, 1 to 4 channels.
  /// Throws std::invalid_argument when the image is not of the raw camera's size.
  void apply(const cv::Mat& raw_image, cv::Mat& destination) const;

 private:
  void map_perspective(const LensCamera& raw, const Eigen::Matrix3d& rectified_from_raw,
                       const PinholeCamera& rectified);
  void map_wide(const LensCamera& raw, const Eigen::Matrix3d& rectified_from_raw, const PinholeCamera& rectified);
  void pack();
  void look_up_rows(const cv::Mat& raw_image, cv::Mat& destination) const;
  void patch(const cv::Mat& raw_image, cv::Mat& destination) const;

  cv::Size raw_size_;
  cv::Mat coordinates_;                 ///< CV_16SC2: upper left of the four neighbours
  cv::Mat fractions_;                   ///< CV_16UC1: 32 * y + x
  cv::Mat unseen_;                      ///< CV_8UC1, 255 where the lens sees nothing; empty: it sees all
  std::vector<std::uint32_t> lookups_;  ///< row by row; empty: the raw image is too large for them
  std::vector<cv::Point> patches_;      ///< pixels whose neighbours do not all lie in the raw image
};

}  // namespace panvo::vision
