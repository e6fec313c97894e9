// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/image_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace panvo::vision {
namespace {

constexpr int kGridStep_px = 8;
constexpr int kDark = 8;               // grey level: upper limit with a capped lens
constexpr int kBright = 250;           // grey level: saturation, allowing for smoothing
constexpr double kFaultyShare = 0.98;  // accepts the lamps of a night scene, a sign against a white sky
constexpr double kMinContrast = 2.0;   // grey levels, standard deviation: noise of a uniform wall

}  // namespace

std::optional<std::string> find_fault(const cv::Mat& image) {
  if (image.empty()) return "is empty";
  if (image.type() != CV_8UC1) return "is not an 8-bit grey image";
  double count = 0.0, dark = 0.0, bright = 0.0, sum = 0.0, square = 0.0;
  for (int row = 0; row < image.rows; row += kGridStep_px) {
    const uchar* pixels = image.ptr<uchar>(row);
    for (int column = 0; column < image.cols; column += kGridStep_px) {
      const int grey = pixels[column];
      count += 1.0;
      dark += grey <= kDark ? 1.0 : 0.0;
      bright += grey >= kBright ? 1.0 : 0.0;
      sum += grey;
      square += grey * grey;
    }
  }
  const double deviation = std::sqrt(std::max(0.0, square / count - sum * sum / (count * count)));
  std::ostringstream text;
  text.precision(3);
  if (dark > kFaultyShare * count) {
    text << "is black: " << 100.0 * dark / count << " % of the pixels at grey level " << kDark << " or below";
  } else if (bright > kFaultyShare * count) {
    text << "is saturated: " << 100.0 * bright / count << " % of the pixels at grey level " << kBright << " or above";
  } else if (deviation < kMinContrast) {
    text << "is constant: standard deviation of the grey levels is " << deviation << ", at least " << kMinContrast
         << " required";
  } else {
    return std::nullopt;
  }
  return text.str();
}

}  // namespace panvo::vision
