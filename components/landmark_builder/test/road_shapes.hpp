// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace panvo::landmark_builder {

inline constexpr double kResolution_m = 0.25;
inline constexpr int kSide = 217;  // px
inline constexpr double kDegree = M_PI / 180.0;

inline cv::Point middle_pixel() { return {kSide / 2, kSide / 2}; }

inline cv::Mat empty_mask() { return cv::Mat::zeros(kSide, kSide, CV_8UC1); }

/// Roads 6.5 m wide from the middle, in directions counter-clockwise from "up", with rounded corners.
inline cv::Mat star_mask(const std::vector<double>& directions_deg, double length_m = 40.0, double width_m = 6.5) {
  cv::Mat mask = empty_mask();
  for (const double direction : directions_deg) {
    const double px = length_m / kResolution_m;
    const cv::Point end(static_cast<int>(std::lround(kSide / 2 - px * std::sin(direction * kDegree))),
                        static_cast<int>(std::lround(kSide / 2 - px * std::cos(direction * kDegree))));
    cv::line(mask, middle_pixel(), end, 255, static_cast<int>(width_m / kResolution_m));
  }
  cv::Mat padded;
  cv::copyMakeBorder(mask, padded, 20, 20, 20, 20, cv::BORDER_REPLICATE);
  cv::morphologyEx(padded, padded, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_ELLIPSE, {25, 25}));
  return padded(cv::Rect(20, 20, kSide, kSide)).clone();
}

/// A road along a circle of `radius_m` through the middle.
inline cv::Mat curve_mask(double radius_m) {
  cv::Mat mask = empty_mask();
  const int radius = static_cast<int>(radius_m / kResolution_m);
  cv::circle(mask, middle_pixel() + cv::Point(radius, 0), radius, 255, static_cast<int>(6.5 / kResolution_m));
  return mask;
}

}  // namespace panvo::landmark_builder
