// SPDX-License-Identifier: Apache-2.0
#include "brief_pattern.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>
#include <stdexcept>

namespace panvo::evaluation {
namespace {

/// Approximately Gaussian with mean 0 and variance 1: a sum of twelve uniform samples, identical on every platform.
double gaussian(std::mt19937_64& random) {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += static_cast<double>(random() >> 11) * 0x1p-53;
  return sum;
}

int coordinate(std::mt19937_64& random) {
  constexpr int kPatch = BriefPattern::kPatch_px;
  return std::clamp(static_cast<int>(std::floor(kPatch / 2.0 + kPatch / 5.0 * gaussian(random))), 0, kPatch - 1);
}

cv::Point point(std::mt19937_64& random) {
  const int x = coordinate(random);
  return {x, coordinate(random)};
}

}  // namespace

BriefPattern::BriefPattern(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  while (comparisons_.size() < kBits) {
    const auto first = point(random);
    const auto second = point(random);
    if (first != second) comparisons_.push_back({first, second});
  }
}

BriefPattern::Bits BriefPattern::describe(const cv::Mat& smoothed, int left) const {
  Bits bits{};
  const auto value = [&](const cv::Point& p) { return smoothed.at<std::uint8_t>(p.y, (left + p.x) % smoothed.cols); };
  for (std::size_t i = 0; i < comparisons_.size(); ++i) {
    const bool is_darker = value(comparisons_[i].first) < value(comparisons_[i].second);
    bits[i / 64] |= static_cast<std::uint64_t>(is_darker) << (i % 64);
  }
  return bits;
}

int hamming_distance(const BriefPattern::Bits& a, const BriefPattern::Bits& b) {
  int different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) different += std::popcount(a[i] ^ b[i]);
  return different;
}

cv::Mat described_band(const cv::Mat& panorama) {
  if (panorama.type() != CV_8UC1 || panorama.cols != 1080 || panorama.rows != 540) {
    throw std::invalid_argument("a panorama must be CV_8UC1 and 1080x540");
  }
  return panorama.rowRange(165, 315);
}

cv::Mat smoothed_band(const cv::Mat& panorama, int columns) {
  constexpr int kBorder = 8;
  cv::Mat small, padded, smoothed;
  cv::resize(described_band(panorama), small, {columns, BriefPattern::kPatch_px}, 0.0, 0.0, cv::INTER_AREA);
  cv::copyMakeBorder(small, padded, 0, 0, kBorder, kBorder, cv::BORDER_WRAP);
  cv::GaussianBlur(padded, smoothed, {9, 9}, 2.0, 2.0, cv::BORDER_REPLICATE);
  return smoothed.colRange(kBorder, kBorder + columns).clone();
}

}  // namespace panvo::evaluation
