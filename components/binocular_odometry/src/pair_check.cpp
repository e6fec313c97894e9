// SPDX-License-Identifier: Apache-2.0
#include "pair_check.hpp"

#include <cmath>

#include "panvo/vision/image_check.hpp"

namespace panvo::binocular_odometry {
namespace {

constexpr int kMinSeen = 20;
// Recordings have at least 0.75, mostly 0.9. A half-covered camera gives 0.5; a camera that is one frame late gives
// less at 5 m/s.
constexpr double kSeenByBoth = 0.5;

std::string size_text(int width, int height) { return std::to_string(width) + " x " + std::to_string(height) + " px"; }

}  // namespace

std::optional<std::string> PairCheck::find_fault(const StereoFrame& frame) const {
  if (const auto fault = fault_of("left image", frame.left)) return fault;
  if (const auto fault = fault_of("right image", frame.right)) return fault;
  const auto left_repeats = left_.find_fault(frame.left);
  const auto right_repeats = right_.find_fault(frame.right);
  if (left_repeats && right_repeats) return "both cameras repeat their images (frozen)";
  if (left_repeats) return "left camera " + *left_repeats;
  if (right_repeats) return "right camera " + *right_repeats;
  if (vision::are_same(frame.left, frame.right)) return "left and right images are identical: both show one camera";
  return std::nullopt;
}

void PairCheck::remember(const StereoFrame& frame) {
  left_.remember(frame.left);
  right_.remember(frame.right);
}

std::optional<std::string> PairCheck::fault_of(const char* name, const cv::Mat& image) const {
  if (const auto fault = vision::find_fault(image)) return std::string(name) + " " + *fault;
  if (image.cols == camera_.width && image.rows == camera_.height) return std::nullopt;
  return std::string(name) + " is " + size_text(image.cols, image.rows) + ", the calibration is for " +
         size_text(camera_.width, camera_.height);
}

std::optional<std::string> find_disagreement(int seen, int seen_by_both) {
  const int needed = static_cast<int>(std::ceil(kSeenByBoth * seen));
  if (seen < kMinSeen || seen_by_both >= needed) return std::nullopt;
  return "left and right images do not match: of " + std::to_string(seen) + " features tracked in the left image, " +
         std::to_string(seen_by_both) + " were found in the right image, " + std::to_string(needed) + " needed";
}

}  // namespace panvo::binocular_odometry
