// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace panvo::vision {

/// An image at full, half, quarter ... size. Pixel x of level l corresponds to x * 2^l in the original image.
/// Owns its pixels, independent of the caller's image. Copies share the pixels.
class ImagePyramid {
 public:
  ImagePyramid() = default;

  /// `image`: CV_8UC1, not empty. Builds up to `levels` levels; no level is smaller than 32 px per side, except level
  /// 0. Level 0 is smoothed (3x3 binomial): bilinear interpolation of a sharper image would bias sub-pixel positions
  /// towards the pixel grid.
  ImagePyramid(const cv::Mat& image, int levels);

  int levels() const { return static_cast<int>(images_.size()); }
  const cv::Mat& operator[](int level) const { return images_[static_cast<size_t>(level)]; }

 private:
  std::vector<cv::Mat> images_;
};

}  // namespace panvo::vision
