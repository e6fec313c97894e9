// SPDX-License-Identifier: Apache-2.0
#include "pair_check.hpp"

#include "panvo/vision/image_check.hpp"

namespace panvo::binocular_odometry {
namespace {

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

}  // namespace panvo::binocular_odometry
