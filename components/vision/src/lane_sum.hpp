// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/hal/intrin.hpp>

namespace panvo::vision {

/// Sum of four lanes, (0 + 2) + (1 + 3), on every processor; the order of cv::v_reduce_sum, and so its rounding, differs
/// between them.
inline float lane_sum(const cv::v_float32x4& lanes) {
  const cv::v_float32x4 pairs = lanes + cv::v_rotate_right<2>(lanes);
  return (pairs + cv::v_rotate_right<1>(pairs)).get0();
}

}  // namespace panvo::vision
