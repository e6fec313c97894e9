// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>

#include "panvo/odometry_fusion/odometry_fusion.hpp"

namespace panvo::odometry_fusion {

/// Carries the localizer's last pose in the map, which arrives later than fused poses, on by what was fused since.
class MapAnchor {
 public:
  /// Adds a fused pose. A stamp that is not later than the previous one resets the anchor.
  void add(const FusedPose& fused);

  /// Takes the pose in the map that belongs to a fused pose. False, without effect: no fused pose has that stamp.
  bool set(std::int64_t stamp_ns, const Eigen::Isometry3d& map_from_base, const vision::Matrix6d& covariance);

  /// `fused` with pose and covariance in the map. nullopt: no pose in the map in the two seconds before.
  std::optional<FusedPose> in_map(const FusedPose& fused) const;

 private:
  static constexpr double kKept_s = 2.0;

  struct Anchor {
    FusedPose fused;
    Eigen::Isometry3d map_from_base;
    vision::Matrix6d covariance;
  };

  std::deque<FusedPose> fused_;
  std::optional<Anchor> anchor_;
};

}  // namespace panvo::odometry_fusion
