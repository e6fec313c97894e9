// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "panvo/vision/camera.hpp"
#include "panvo/vision/lens.hpp"

namespace panvo::vision {

/// Look-up table from a raw image to its rectified image, in steps of 1/32 px; the output is identical to OpenCV's
/// remap. 8-bit images with 1 or 3 channels use packed look-ups, other images use remap.
class RectificationMap {
 public:
  /// Maps images of `raw` to images of `rectified`, whose frame is rotated by `rectified_from_raw`. Pixels that a wide
  /// lens does not see are black. Throws std::invalid_argument where CameraModel does.
  RectificationMap(const LensCamera& raw, const Eigen::Matrix3d& rectified_from_raw, const PinholeCamera& rectified);

  /// Writes the rectified image to `destination` (reallocated if size or type differ); any depth, 1 to 4 channels.
  /// Throws std::invalid_argument if the image size differs from that of the raw camera.
  void apply(const cv::Mat& raw_image, cv::Mat& destination) const;

 private:
  void map_perspective(const LensCamera& raw, const Eigen::Matrix3d& rectified_from_raw,
                       const PinholeCamera& rectified);
  void map_wide(const LensCamera& raw, const Eigen::Matrix3d& rectified_from_raw, const PinholeCamera& rectified);
  void pack();
  void look_up_rows(const cv::Mat& raw_image, cv::Mat& destination) const;
  void patch(const cv::Mat& raw_image, cv::Mat& destination) const;

  cv::Size raw_size_;
  cv::Mat coordinates_;                 ///< CV_16SC2: upper left neighbour
  cv::Mat fractions_;                   ///< CV_16UC1: 32 * y + x
  cv::Mat unseen_;                      ///< CV_8UC1, 255: not seen by the lens; empty: all pixels are seen
  std::vector<std::uint32_t> lookups_;  ///< row-major; empty if the raw image is too large
  std::vector<cv::Point> patches_;      ///< pixels with neighbours outside the raw image
};

}  // namespace panvo::vision
