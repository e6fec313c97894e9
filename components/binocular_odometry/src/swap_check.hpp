// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "front_end.hpp"
#include "panvo/vision/image_pyramid.hpp"
#include "panvo/vision/stereo_matcher.hpp"

namespace panvo::binocular_odometry {

/// Detects swapped left and right images: features match with negative disparity.
class SwapCheck {
 public:
  /// `range`: search range of a correct pair.
  SwapCheck(const vision::PinholeCamera& camera, vision::StereoMatcher::Range range, double min_correlation)
      : swapped_matcher_(camera, {-range.to_px, -1.0}, min_correlation) {}

  /// `matched` of `tried` features match with positive disparity; the check only runs if these are few. `features`:
  /// features of the left image.
  std::optional<std::string> find_fault(int matched, double tried, const vision::StereoMatcher& matcher,
                                        const vision::ImagePyramid& left, const vision::ImagePyramid& right,
                                        const std::function<std::vector<Feature>()>& features) const;

 private:
  vision::StereoMatcher swapped_matcher_;
};

}  // namespace panvo::binocular_odometry
