// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/keypoints.hpp"

#include <stdexcept>

namespace panvo::landmarks {

std::vector<Keypoint> detect_keypoints(const cv::Mat& panorama, const KeypointParameters&) {
  if (panorama.empty()) throw std::invalid_argument("keypoints of an empty panorama");
  return {};
}

std::vector<KeypointMatch> match_keypoints(std::span<const Keypoint>, std::span<const Keypoint>, float,
                                           const std::optional<AzimuthWindow>&) {
  return {};
}

}  // namespace panvo::landmarks
