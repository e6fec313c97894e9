// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace panvo::binocular_odometry {

/// A synchronised, rectified image pair. The pixels are only read during the call and not stored.
struct StereoFrame {
  std::int64_t stamp_ns = 0;
  cv::Mat left;   ///< CV_8UC1, of the calibrated size
  cv::Mat right;  ///< as left
};

}  // namespace panvo::binocular_odometry
