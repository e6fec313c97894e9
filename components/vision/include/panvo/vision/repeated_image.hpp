// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace panvo::vision {

/// Detects an image that is identical to the previous one (frozen camera, driver or cable). Sensor noise never repeats,
/// so no threshold is needed. A noise-free rendered or strongly compressed stream at standstill is reported, too.
class RepeatedImage {
 public:
  /// Returns the fault of an image that repeats the one remembered; nullopt if it is new. Compares every eighth row.
  std::optional<std::string> find_fault(const cv::Mat& image) const;
  /// Remembers an image instead of the one before. Call for every image of a camera, in order, including images with
  /// faults.
  void remember(const cv::Mat& image);

 private:
  cv::Mat rows_;  // of the previous image
};

/// Whether two images have the same pixels in every eighth row, e.g. when both streams of a pair come from one camera.
bool are_same(const cv::Mat& a, const cv::Mat& b);

}  // namespace panvo::vision
