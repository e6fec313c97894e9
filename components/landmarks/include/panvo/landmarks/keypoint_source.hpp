// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "panvo/landmarks/panoramic_landmark.hpp"

namespace panvo::landmarks {

/// Storage of the SIFT features of landmarks that are not kept in memory. They make up nine tenths of a landmark and
/// are needed only for the landmark that is being matched.
class KeypointSource {
 public:
  KeypointSource() = default;
  KeypointSource(const KeypointSource&) = delete;
  KeypointSource& operator=(const KeypointSource&) = delete;
  virtual ~KeypointSource() = default;

  /// Keypoints of the landmark with this id, in stored order; empty if it has none or is unknown. May throw storage
  /// errors.
  virtual std::vector<Keypoint> keypoints(std::uint32_t id) const = 0;
};

}  // namespace panvo::landmarks
