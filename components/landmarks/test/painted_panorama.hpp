// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "panvo/vision/equirectangular.hpp"

namespace panvo::landmarks {

/// 1080x540 with blocks of every size; each seed gives another place.
inline cv::Mat paint_panorama(std::uint64_t seed) {
  cv::RNG random(seed);
  cv::Mat panorama(540, 1080, CV_8UC1, cv::Scalar(200));
  panorama.rowRange(270, 540).setTo(90);
  for (int i = 0; i < 220; ++i) {
    const cv::Rect block{random.uniform(0, 1060), random.uniform(120, 290), random.uniform(8, 90),
                         random.uniform(8, 70)};
    cv::rectangle(panorama, block, cv::Scalar(random.uniform(10, 245)), cv::FILLED);
  }
  return panorama;
}

/// The view of a vehicle turned left by so many columns.
inline cv::Mat turn_left(const cv::Mat& panorama, int columns) {
  cv::Mat turned(panorama.size(), panorama.type());
  for (int u = 0; u < panorama.cols; ++u) panorama.col(u).copyTo(turned.col((u + columns) % panorama.cols));
  return turned;
}

}  // namespace panvo::landmarks
