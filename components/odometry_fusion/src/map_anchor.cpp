// SPDX-License-Identifier: Apache-2.0
#include "panvo/odometry_fusion/map_anchor.hpp"

#include <algorithm>

#include "panvo/vision/step_covariance.hpp"

namespace panvo::odometry_fusion {

void MapAnchor::add(const FusedPose& fused) {
  if (!fused_.empty() && fused.stamp_ns <= fused_.back().stamp_ns) *this = {};
  fused_.push_back(fused);
  while (seconds(fused_.front().stamp_ns, fused.stamp_ns) > kKept_s) fused_.pop_front();
}

bool MapAnchor::set(std::int64_t stamp_ns, const Eigen::Isometry3d& map_from_base, const vision::Matrix6d& covariance) {
  const auto fused = std::ranges::find(fused_, stamp_ns, &FusedPose::stamp_ns);
  if (fused == fused_.end()) return false;
  anchor_ = {*fused, map_from_base, covariance};
  return true;
}

std::optional<FusedPose> MapAnchor::in_map(const FusedPose& fused) const {
  if (!anchor_ || seconds(anchor_->fused.stamp_ns, fused.stamp_ns) > kKept_s) return std::nullopt;
  const FusedPose& from = anchor_->fused;
  const Eigen::Isometry3d since = from.odom_from_base.inverse() * fused.odom_from_base;
  const vision::Matrix6d grown =
      vision::step_covariance(from.odom_from_base, from.covariance, fused.odom_from_base, fused.covariance);
  FusedPose in_map = fused;
  in_map.odom_from_base = anchor_->map_from_base * since;
  in_map.covariance = vision::compose_covariance(anchor_->map_from_base, anchor_->covariance, since, grown);
  return in_map;
}

}  // namespace panvo::odometry_fusion
