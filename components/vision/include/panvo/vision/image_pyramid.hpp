// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace panvo::vision {

/// An image at full, half, quarter ... size. Pixel x of level l lies at x * 2^l of the image it was made from.
/// Owns its pixels, so a patch can still be read from it after the caller's image is gone. Copies share the pixels.
class ImagePyramid {
 public:
  ImagePyramid() = default;

  /// Levels of a grey image (CV_8UC1, not empty), as many as asked for but none smaller than 32 pixels on a side.
  /// Level 0 is smoothed lightly (3x3 binomial): bilinear interpolation of a sharper image would pull sub-pixel positions
  /// towards the pixel grid.
  ImagePyramid(const cv::Mat& image, int levels);

  int levels() const { return static_cast<int>(images_.size()); }
  const cv::Mat& operator[](int level) const { return images_[static_cast<size_t>(level)]; }

 private:
  std::vector<cv::Mat> images_;
};

}  // namespace panvo::vision
