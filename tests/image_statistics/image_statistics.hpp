// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

namespace panvo::testing {

/// Statistics of one street image that matter for vision; comparable between image sizes.
struct ImageStatistics {
  double fast_per_megapixel = 0.0;  ///< FAST corners with threshold 20
  double sift_per_megapixel = 0.0;  ///< SIFT keypoints
  double gradient_median = 0.0;     ///< of the Sobel magnitude, grey levels per pixel
  double gradient_90 = 0.0;         ///< its 90 % quantile
  double spectrum_slope =
      0.0;  ///< of log power over log frequency, 1/64 to 1/3 cycles per pixel; -2.4 to -1.6 for natural images
  std::array<double, 5> octaves{};  ///< rms of the levels of the Laplacian pyramid, finest first, grey levels
};

ImageStatistics measure(const cv::Mat& grey);

/// Fraction of the SIFT keypoints of `first` that are matched in `second` (ratio 0.8, mutual, consistent epipolar
/// geometry).
double survival(const cv::Mat& first, const cv::Mat& second);

}  // namespace panvo::testing
