// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

/// Panoramas with known turns.
namespace panvo::panoramic_compass {

inline constexpr int kColumns = 1080, kRows = 540;
inline constexpr double kColumn_rad = 2.0 * std::numbers::pi / kColumns;

/// A street of painted walls around the vehicle under a uniform sky, smooth enough for sub-pixel interpolation.
inline cv::Mat paint_panorama(unsigned seed = 1) {
  std::mt19937_64 random(seed);
  const auto whole = [&](int from, int to) {
    return from + static_cast<int>(random() % static_cast<std::uint64_t>(to - from));
  };
  cv::Mat wide(kRows, 3 * kColumns, CV_8UC1, cv::Scalar(220));
  wide.rowRange(kRows / 2, kRows).setTo(cv::Scalar(90));
  const auto rectangle = [&](const cv::Rect& r, int grey) {
    for (int turn = 0; turn < 3; ++turn) cv::rectangle(wide, r + cv::Point(turn * kColumns, 0), cv::Scalar(grey), -1);
  };
  for (int x = 0; x < kColumns; x += 40) {  // walls
    const int top = whole(100, 240);
    const int grey = whole(40, 200);
    rectangle({x, top, whole(25, 60), 290 - top}, grey);
  }
  for (int i = 0; i < 700; ++i) {  // details on the walls
    const int grey = whole(20, 235);
    rectangle({whole(0, kColumns), whole(110, 290), whole(4, 16), whole(4, 16)}, grey);
  }
  cv::GaussianBlur(wide, wide, cv::Size(9, 9), 1.5);
  return wide.colRange(kColumns, 2 * kColumns).clone();
}

/// A far scene after the vehicle has turned left by `columns` (may be fractional): it moves right.
inline cv::Mat turned_left(const cv::Mat& panorama, double columns) {
  cv::Mat map_x(panorama.size(), CV_32FC1), map_y(panorama.size(), CV_32FC1), wide, turned;
  constexpr int kMargin = 16;
  cv::copyMakeBorder(panorama, wide, 0, 0, kMargin, kMargin, cv::BORDER_WRAP);
  const double turn = panorama.cols;
  for (int row = 0; row < panorama.rows; ++row) {
    for (int column = 0; column < panorama.cols; ++column) {
      const double from = column - columns - turn * std::floor((column - columns) / turn);
      map_x.at<float>(row, column) = static_cast<float>(from + kMargin);
      map_y.at<float>(row, column) = static_cast<float>(row);
    }
  }
  cv::remap(wide, turned, map_x, map_y, cv::INTER_CUBIC);
  return turned;
}

/// The same scene, with walls on a cylinder of 1 m radius, after the vehicle has driven `way_m` (< 1) forward and then
/// turned left.
inline cv::Mat driven(const cv::Mat& panorama, double way_m, double turn_rad) {
  cv::Mat map_x(panorama.size(), CV_32FC1), map_y(panorama.size(), CV_32FC1), wide, moved;
  constexpr int kMargin = 16;
  cv::copyMakeBorder(panorama, wide, 0, 0, kMargin, kMargin, cv::BORDER_WRAP);
  for (int column = 0; column < panorama.cols; ++column) {
    // azimuth, left positive, in the vehicle axes before the turn
    const double azimuth = -(column * kColumn_rad - std::numbers::pi) + turn_rad;
    const double along = way_m * std::cos(azimuth);
    const double distance = -along + std::sqrt(along * along + 1.0 - way_m * way_m);  // to the cylinder
    const double seen = std::atan2(distance * std::sin(azimuth), way_m + distance * std::cos(azimuth));
    double from = (std::numbers::pi - seen) / kColumn_rad;
    from -= panorama.cols * std::floor(from / panorama.cols);
    for (int row = 0; row < panorama.rows; ++row) {
      const double height = distance * std::tan((row - kRows / 2) * std::numbers::pi / kRows);  // downwards
      map_x.at<float>(row, column) = static_cast<float>(from + kMargin);
      map_y.at<float>(row, column) = static_cast<float>(std::atan(height) * kRows / std::numbers::pi + kRows / 2.0);
    }
  }
  cv::remap(wide, moved, map_x, map_y, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  return moved;
}

}  // namespace panvo::panoramic_compass
