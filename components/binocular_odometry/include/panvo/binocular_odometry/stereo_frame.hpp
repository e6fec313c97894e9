// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace panvo::binocular_odometry {

/// A rectified pair of one moment. Views: the pixels are read during the call they are given to, and not kept.
struct StereoFrame {
  std::int64_t stamp_ns = 0;
  cv::Mat left;   ///< CV_8UC1, of the calibrated size
  cv::Mat right;  ///< as left
};

}  // namespace panvo::binocular_odometry
