// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/repeated_image.hpp"

#include <cstring>

namespace panvo::vision {
namespace {

constexpr int kRowStep = 8;

std::size_t row_bytes(const cv::Mat& image) { return static_cast<std::size_t>(image.cols) * image.elemSize(); }

int kept_rows(const cv::Mat& image) { return (image.rows + kRowStep - 1) / kRowStep; }

// Compares every kRowStep-th row of `image` with every `other_step`-th row of `other`.
bool rows_are_same(const cv::Mat& image, const cv::Mat& other, int other_step) {
  for (int row = 0, at = 0; row < image.rows; row += kRowStep, at += other_step) {
    if (std::memcmp(image.ptr(row), other.ptr(at), row_bytes(image)) != 0) return false;
  }
  return true;
}

}  // namespace

std::optional<std::string> RepeatedImage::find_fault(const cv::Mat& image) const {
  const bool is_like_before =
      rows_.rows == kept_rows(image) && rows_.cols == image.cols && rows_.type() == image.type() && !image.empty();
  if (is_like_before && rows_are_same(image, rows_, 1)) return "repeats its image (frozen)";
  return std::nullopt;
}

void RepeatedImage::remember(const cv::Mat& image) {
  rows_.create(kept_rows(image), image.cols, image.type());
  for (int row = 0; row < image.rows; row += kRowStep) {
    std::memcpy(rows_.ptr(row / kRowStep), image.ptr(row), row_bytes(image));
  }
}

bool are_same(const cv::Mat& a, const cv::Mat& b) {
  return !a.empty() && a.size() == b.size() && a.type() == b.type() && rows_are_same(a, b, kRowStep);
}

}  // namespace panvo::vision
