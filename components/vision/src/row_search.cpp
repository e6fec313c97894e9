// SPDX-License-Identifier: Apache-2.0
#include "row_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <opencv2/core/hal/intrin.hpp>
#include <vector>

namespace panvo::vision {
namespace {

constexpr int kWindow = 8;  // px: one vector of 16-bit values per row
constexpr int kPixels = kWindow * kWindow;
constexpr double kMinVariance = 2.0 * 2.0;  // grey levels squared
constexpr int kPeakWidth_px = 2;            // nearer maxima count as one
constexpr double kMinLead = 0.05;           // of the best correlation over the second best position

cv::v_int16x8 load(const uchar* pixels) { return cv::v_reinterpret_as_s16(cv::v_load_expand(pixels)); }

}  // namespace

std::optional<int> search_row(const cv::Mat& left, const cv::Mat& right, cv::Point pixel, int rows_below, int from,
                              int to, double min_correlation) {
  const int top = pixel.y - kWindow / 2, column = pixel.x - kWindow / 2;
  if (top < 0 || column < 0 || top + kWindow > left.rows || column + kWindow > left.cols) return std::nullopt;
  const int right_top = top + rows_below;
  if (right_top < 0 || right_top + kWindow > right.rows) return std::nullopt;
  from = std::max(from, column + kWindow - right.cols);
  to = std::min(to, column);
  if (from > to) return std::nullopt;

  const cv::v_int16x8 ones = cv::v_setall_s16(1);
  std::array<cv::v_int16x8, kWindow> window;
  double sum_left = 0.0, square_left = 0.0;
  for (int row = 0; row < kWindow; ++row) {
    const auto values = load(left.ptr<uchar>(top + row) + column);
    window[static_cast<size_t>(row)] = values;
    sum_left += cv::v_reduce_sum(cv::v_dotprod(values, ones));
    square_left += cv::v_reduce_sum(cv::v_dotprod(values, values));
  }
  const double variance_left = square_left / kPixels - sum_left * sum_left / (kPixels * kPixels);
  if (variance_left < kMinVariance) return std::nullopt;

  std::vector<double> correlations;
  correlations.reserve(static_cast<size_t>(to - from + 1));
  for (int disparity = from; disparity <= to; ++disparity) {
    cv::v_int32x4 sum = cv::v_setzero_s32(), square = sum, product = sum;
    for (int row = 0; row < kWindow; ++row) {
      const auto values = load(right.ptr<uchar>(right_top + row) + column - disparity);
      sum = cv::v_dotprod(values, ones, sum);
      square = cv::v_dotprod(values, values, square);
      product = cv::v_dotprod(values, window[static_cast<size_t>(row)], product);
    }
    const double mean = static_cast<double>(cv::v_reduce_sum(sum)) / kPixels;
    const double variance = static_cast<double>(cv::v_reduce_sum(square)) / kPixels - mean * mean;
    const double covariance = static_cast<double>(cv::v_reduce_sum(product)) / kPixels - mean * sum_left / kPixels;
    correlations.push_back(variance < kMinVariance ? -1.0 : covariance / std::sqrt(variance * variance_left));
  }

  const auto best = std::max_element(correlations.begin(), correlations.end());
  if (*best < min_correlation) return std::nullopt;
  for (auto other = correlations.begin(); other != correlations.end(); ++other) {
    if (std::abs(other - best) > kPeakWidth_px && *other > *best - kMinLead) return std::nullopt;
  }
  return from + static_cast<int>(best - correlations.begin());
}

}  // namespace panvo::vision
