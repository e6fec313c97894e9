// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "panvo/landmarks/panoramic_landmark.hpp"

namespace panvo::landmarks {

/// Where the SIFT features of landmarks lie that are not in memory: they are nine tenths of a landmark, and needed only
/// for the one that is being matched.
class KeypointSource {
 public:
  KeypointSource() = default;
  KeypointSource(const KeypointSource&) = delete;
  KeypointSource& operator=(const KeypointSource&) = delete;
  virtual ~KeypointSource() = default;

  /// Of the landmark with this id, in their order; empty when it has none or is not known. May throw what storage throws.
  virtual std::vector<Keypoint> keypoints(std::uint32_t id) const = 0;
};

}  // namespace panvo::landmarks
