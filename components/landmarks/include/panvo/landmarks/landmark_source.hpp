// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "panvo/landmarks/panoramic_landmark.hpp"

namespace panvo::landmarks {

/// Storage of what a library does not keep in memory: the SIFT features of its landmarks, nine tenths of each, and their
/// descriptions. Both are needed only for landmarks that are being compared. Functions may throw storage errors.
class LandmarkSource {
 public:
  LandmarkSource() = default;
  LandmarkSource(const LandmarkSource&) = delete;
  LandmarkSource& operator=(const LandmarkSource&) = delete;
  virtual ~LandmarkSource() = default;

  /// Keypoints of the landmark with this id, in stored order; empty if it has none or is unknown.
  virtual std::vector<Keypoint> keypoints(std::uint32_t id) const = 0;
  /// Empty if the landmark has none or is unknown.
  virtual PanoramaDescription description(std::uint32_t id) const = 0;
};

}  // namespace panvo::landmarks
