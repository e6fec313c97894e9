// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace panvo::vision {

/// Tells an image that is the one before it, pixel by pixel: a camera, a driver or a cable that hangs. The noise of a sensor never repeats, so
/// there are no thresholds. It cannot tell a hung camera from one that renders without noise, or encodes with loss until nothing is left of
/// the noise, while it stands: those repeat as well, and are said to.
class RepeatedImage {
 public:
  /// Why an image is no new measurement; nullopt when it is one. Every image of one camera is to pass, in order, whatever else is wrong with it.
  /// Compares and keeps every eighth row: a comparison ends at the first pixel that differs.
  std::optional<std::string> find_fault(const cv::Mat& image);

 private:
  cv::Mat rows_;  // of the image before
};

/// Whether two images have the same pixels: both eyes of a pair show what one camera sees. In every eighth row.
bool are_same(const cv::Mat& a, const cv::Mat& b);

}  // namespace panvo::vision
