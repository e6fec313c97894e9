// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>
#include <opencv2/core.hpp>

namespace panvo::vision {

/// A smooth non-repeating pattern, grey levels 40 to 215, defined at any position, so that shifted images can be drawn
/// exactly.
inline double pattern(double x, double y) {
  return 128.0 + 30.0 * std::sin(0.41 * x + 0.13 * y) + 25.0 * std::sin(0.23 * y - 0.37 * x + 1.0) +
         18.0 * std::sin(0.61 * y + 0.05 * x + 2.0 * std::sin(0.031 * x)) +
         12.0 * std::sin(0.29 * x + 0.43 * y + 0.0007 * x * y);
}

/// An image whose pixel (u, v) is gain * pattern(place(u, v)) + offset.
inline cv::Mat draw(cv::Size size, const std::function<cv::Point2d(double, double)>& place, double gain = 1.0,
                    double offset = 0.0) {
  cv::Mat image(size, CV_8UC1);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const cv::Point2d at = place(u, v);
      image.at<uchar>(v, u) = cv::saturate_cast<uchar>(gain * pattern(at.x, at.y) + offset);
    }
  }
  return image;
}

inline cv::Mat draw(cv::Size size) {
  return draw(size, [](double u, double v) { return cv::Point2d(u, v); });
}

}  // namespace panvo::vision
