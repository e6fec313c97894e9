// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "panvo/binocular_odometry/stereo_frame.hpp"
#include "panvo/vision/camera.hpp"
#include "panvo/vision/repeated_image.hpp"

namespace panvo::binocular_odometry {

/// What can be wrong with a pair that its pixels show by themselves: no content, another size, an image that is the one before, one image for
/// both eyes.
class PairCheck {
 public:
  explicit PairCheck(const vision::PinholeCamera& camera) : camera_(camera) {}

  /// Why the pair cannot be used; nullopt when it may be. Every pair is to pass, in order of arrival.
  std::optional<std::string> find_fault(const StereoFrame& frame);

 private:
  std::optional<std::string> fault_of(const char* name, const cv::Mat& image) const;

  vision::PinholeCamera camera_;
  vision::RepeatedImage left_, right_;
};

/// Why two eyes do not look at the same, where of `seen` features followed in the left image `seen_by_both` are found in the right one: it
/// hangs behind, is covered, blurred or turned. nullopt where they do, or too few are seen to say.
std::optional<std::string> find_disagreement(int seen, int seen_by_both);

}  // namespace panvo::binocular_odometry
