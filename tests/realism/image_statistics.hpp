// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

namespace panvo::testing {

/// What a vision system lives on, measured on one image of a street; comparable between cameras of any size.
struct ImageStatistics {
  double fast_per_megapixel = 0.0;  ///< FAST corners of threshold 20
  double sift_per_megapixel = 0.0;  ///< SIFT keypoints
  double gradient_median = 0.0;     ///< of the Sobel magnitude, grey levels a pixel
  double gradient_90 = 0.0;         ///< its 90 % quantile
  double spectrum_slope =
      0.0;  ///< of log power over log frequency, 1/64 to 1/3 cycles a pixel: natural images -2.4 to -1.6
  std::array<double, 5> octaves{};  ///< rms of the Laplacian pyramid's levels, finest first, grey levels
};

ImageStatistics measure(const cv::Mat& grey);

/// Share of the SIFT keypoints of `first` that are found again in `second` (ratio 0.8, mutual, on one epipolar geometry).
double survival(const cv::Mat& first, const cv::Mat& second);

}  // namespace panvo::testing
