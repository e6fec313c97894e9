// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/panorama_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <vector>

#include "panvo/vision/equirectangular.hpp"
#include "panvo/vision/panorama_cover.hpp"

namespace panvo::landmarks {
namespace {

constexpr int kMinColumns = 256;  // px: below, the smallest rectangles have only a few pixels
constexpr int kGridRows = 40, kGridColumns = 120;
constexpr int kDark = 8;                                   // grey level still recorded with the lens cap on
constexpr int kBright = 250;                               // grey level: saturation, with a margin for smoothing
constexpr double kFaultyShare = 0.9;                       // lamps are bright at night, a bright sky fills at most half
constexpr double kMinGreyContrast = 3.0;                   // grey levels, standard deviation: noise on an even wall
constexpr double kBandTop = 1.0 / 3.0, kBandBottom = 0.6;  // relevant rows: 30 degrees above the horizon to 18 below
constexpr double kMaxCovered = 1.0 / 3.0;

/// Approximate grey level of a pixel of either type.
int grey_at(const cv::Mat& image, int row, int column) {
  const uchar* pixel = image.ptr<uchar>(row) + column * image.channels();
  return image.channels() == 1 ? pixel[0] : (pixel[0] + 2 * pixel[1] + pixel[2]) / 4;
}

struct Levels {
  double count = 0.0, dark = 0.0, bright = 0.0, sum = 0.0, square = 0.0;

  void add(int grey) {
    count += 1.0;
    dark += grey <= kDark ? 1.0 : 0.0;
    bright += grey >= kBright ? 1.0 : 0.0;
    sum += grey;
    square += grey * grey;
  }
  double deviation() const { return std::sqrt(std::max(0.0, square / count - sum * sum / (count * count))); }
};

}  // namespace

std::optional<std::string> find_fault(const cv::Mat& panorama) {
  if (auto fault = vision::find_layout_fault(panorama, kMinColumns)) return fault;
  std::ostringstream text;
  text.precision(3);
  Levels all;
  for (int i = 0; i < kGridColumns; ++i) {
    const int column = i * panorama.cols / kGridColumns;
    for (int j = 0; j < kGridRows; ++j) {
      const double place = kBandTop + (kBandBottom - kBandTop) * (j + 0.5) / kGridRows;
      all.add(grey_at(panorama, static_cast<int>(place * panorama.rows), column));
    }
  }
  const double covered = vision::covered_share(panorama, kBandTop, kBandBottom);
  if (all.dark > kFaultyShare * all.count) {
    text << "is black: " << 100.0 * all.dark / all.count << " % of the view near the horizon is at grey level " << kDark
         << " or below";
  } else if (all.bright > kFaultyShare * all.count) {
    text << "is saturated: " << 100.0 * all.bright / all.count << " % of the view near the horizon is at grey level "
         << kBright << " or above";
  } else if (all.deviation() < kMinGreyContrast) {
    text << "is constant: grey levels near the horizon deviate by " << all.deviation() << " from their mean, "
         << kMinGreyContrast << " required";
  } else if (covered > kMaxCovered) {
    text << "is covered: " << 100.0 * covered << " % of the full turn is blocked";
  } else {
    return std::nullopt;
  }
  return text.str();
}

}  // namespace panvo::landmarks
