// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "panvo/binocular_odometry/stereo_frame.hpp"
#include "panvo/vision/camera.hpp"
#include "panvo/vision/repeated_image.hpp"

namespace panvo::binocular_odometry {

/// Checks the pixels of a pair: no content, wrong size, image identical to the previous one, or left and right
/// identical.
class PairCheck {
 public:
  explicit PairCheck(const vision::PinholeCamera& camera) : camera_(camera) {}

  /// Returns the fault of a pair; nullopt if there is none.
  std::optional<std::string> find_fault(const StereoFrame& frame) const;
  /// Remembers a pair for the check of the next one. Call for every pair, in order of arrival, including those with
  /// faults.
  void remember(const StereoFrame& frame);

 private:
  std::optional<std::string> fault_of(const char* name, const cv::Mat& image) const;

  vision::PinholeCamera camera_;
  vision::RepeatedImage left_, right_;
};

}  // namespace panvo::binocular_odometry
