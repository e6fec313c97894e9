// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/panorama_cover.hpp"

namespace panvo::vision {
namespace {

constexpr int kGridRows = 40, kGridColumns = 120;
constexpr double kCoveredContrast = 2.0;  // grey levels, standard deviation within a column

/// Approximate grey level of a grey or colour pixel.
int grey_at(const cv::Mat& image, int row, int column) {
  const uchar* pixel = image.ptr<uchar>(row) + column * image.channels();
  return image.channels() == 1 ? pixel[0] : (pixel[0] + 2 * pixel[1] + pixel[2]) / 4;
}

}  // namespace

double covered_share(const cv::Mat& panorama, double from_row, double to_row) {
  int covered = 0;
  for (int i = 0; i < kGridColumns; ++i) {
    const int column = i * panorama.cols / kGridColumns;
    double sum = 0.0, square = 0.0;
    for (int j = 0; j < kGridRows; ++j) {
      const double place = from_row + (to_row - from_row) * (j + 0.5) / kGridRows;
      const int grey = grey_at(panorama, static_cast<int>(place * panorama.rows), column);
      sum += grey;
      square += grey * grey;
    }
    const double mean = sum / kGridRows, variance = square / kGridRows - mean * mean;
    covered += variance < kCoveredContrast * kCoveredContrast ? 1 : 0;
  }
  return static_cast<double>(covered) / kGridColumns;
}

}  // namespace panvo::vision
