// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>

#include "panvo/landmarks/panoramic_landmark.hpp"

namespace panvo::landmarks {

/// Ids that two landmarks have: one that a component keeps, and one that was built without knowledge of it. Which of them
/// the map's owner means by the id depends on which it heard of first. Its poses tell: each is that of the landmark that is
/// nearer.
class IdDisputes {
 public:
  /// A landmark is there, as far as is known without dispute; no effect if it is known.
  void keep(const LandmarkPose& pose) { kept_.try_emplace(pose.id, Places{pose, pose, {}}); }
  void forget(std::uint32_t id) { kept_.erase(id); }
  /// Another landmark has the id of one that is kept. Returns the pose that it goes back to, if it was moved to the other.
  std::optional<LandmarkPose> begin(const LandmarkPose& other);
  bool is_disputed(std::uint32_t id) const;
  /// Whether the owner's pose is that of the landmark that is kept.
  bool move(const LandmarkPose& pose);

 private:
  struct Places {
    LandmarkPose first, now;                 ///< of the landmark that is kept
    std::optional<Eigen::Vector3d> other{};  ///< of the other one
  };

  std::map<std::uint32_t, Places> kept_;
};

}  // namespace panvo::landmarks
