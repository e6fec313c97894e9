// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace panvo::landmarks {

struct SiftRule {
  int most = 0;               ///< features
  double min_contrast = 0.0;  ///< as of cv::SIFT
  bool upright = false;       ///< descriptors without a rotation of their own
  int sectors = 1;            ///< of the image, each with an equal share of the features first
};

struct SiftFeature {
  cv::KeyPoint keypoint;
  std::array<std::uint8_t, 128> descriptor{};
};

/// The strongest SIFT features of an image (CV_8UC1), in descending order. `sector_of`: of a keypoint, from 0; nullopt:
/// it is not wanted.
std::vector<SiftFeature> detect_sift(const cv::Mat& image, const SiftRule& rule,
                                     const std::function<std::optional<int>(const cv::KeyPoint&)>& sector_of);

}  // namespace panvo::landmarks
