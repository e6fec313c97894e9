// SPDX-License-Identifier: Apache-2.0
#include "swap_check.hpp"

#include <sstream>

namespace panvo::binocular_odometry {
namespace {

constexpr int kSamples = 80;
constexpr int kMinMatches = 20;
constexpr double kFewMatches = 0.4;  // of the features searched in the right image

}  // namespace

std::optional<std::string> SwapCheck::find_fault(int matched, double tried, const vision::StereoMatcher& matcher,
                                                 const vision::ImagePyramid& left, const vision::ImagePyramid& right,
                                                 const std::function<std::vector<Feature>()>& features) const {
  if (static_cast<double>(matched) > kFewMatches * tried) return std::nullopt;
  int samples = 0, right_way = 0, wrong_way = 0;
  for (const Feature& feature : features()) {
    if (samples++ == kSamples) break;
    if (matcher.search(left, right, feature.pixel)) ++right_way;
    if (swapped_matcher_.search(left, right, feature.pixel)) ++wrong_way;
  }
  if (wrong_way < kMinMatches || wrong_way < 2 * right_way) return std::nullopt;
  std::ostringstream text;
  text << "left and right images appear to be swapped: " << wrong_way << " features match with negative disparity, "
       << right_way << " with positive";
  return text.str();
}

}  // namespace panvo::binocular_odometry
