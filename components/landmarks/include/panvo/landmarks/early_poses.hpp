// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "panvo/landmarks/landmark_store.hpp"

namespace panvo::landmarks {

/// Poses of landmarks that have not arrived: messages of different topics come in any order.
class EarlyPoses {
 public:
  /// Passes each pose to `set(pose) -> bool` and keeps those for which it returns false, in place of earlier ones.
  template <class Set>
  void replace(const std::vector<LandmarkPose>& poses, const Set& set) {
    poses_.clear();
    for (const auto& pose : poses) {
      if (!set(pose)) poses_[pose.id] = pose;
    }
  }

  /// Gives a landmark that arrives its pose, if there is one.
  void apply(PanoramicLandmark& landmark) {
    const auto pose = poses_.find(landmark.id);
    if (pose == poses_.end()) return;
    landmark.map_from_base = pose->second.map_from_base;
    landmark.covariance = pose->second.covariance;
    poses_.erase(pose);
  }

 private:
  std::map<std::uint32_t, LandmarkPose> poses_;
};

}  // namespace panvo::landmarks
