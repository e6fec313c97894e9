// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "panvo/vision/equirectangular.hpp"

namespace panvo::places::test {

/// A seamless panorama, 1080x540, with blocks of every size; each seed gives another place.
inline cv::Mat paint_place(std::uint64_t seed) {
  cv::RNG random(seed);
  cv::Mat panorama(540, 1080, CV_8UC1, cv::Scalar(190));
  panorama.rowRange(270, 540).setTo(100);
  for (int i = 0; i < 500; ++i) {
    const cv::Rect block{random.uniform(0, 1080), random.uniform(110, 370), random.uniform(6, 80),
                         random.uniform(6, 60)};
    const cv::Scalar grey(random.uniform(10, 245));
    cv::rectangle(panorama, block, grey, cv::FILLED);
    cv::rectangle(panorama, block - cv::Point(1080, 0), grey, cv::FILLED);
  }
  cv::GaussianBlur(panorama, panorama, {5, 5}, 0.0, 0.0, cv::BORDER_REPLICATE);
  return panorama;
}

/// The panorama as a camera with this rotation sees it (place_from_view).
inline cv::Mat render(const cv::Mat& panorama, const Eigen::Matrix3d& place_from_view) {
  const vision::Equirectangular sphere{panorama.cols, panorama.rows};
  cv::Mat u(panorama.size(), CV_32F), v(panorama.size(), CV_32F), view;
  for (int row = 0; row < panorama.rows; ++row) {
    for (int column = 0; column < panorama.cols; ++column) {
      const Eigen::Vector2d at = sphere.project(place_from_view * sphere.unproject({column, row}));
      u.at<float>(row, column) = static_cast<float>(at.x());
      v.at<float>(row, column) = static_cast<float>(at.y());
    }
  }
  cv::Mat wrapped;
  cv::copyMakeBorder(panorama, wrapped, 0, 0, 0, 2, cv::BORDER_WRAP);
  cv::remap(wrapped, view, u, v, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return view;
}

}  // namespace panvo::places::test
