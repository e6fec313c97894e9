// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "panvo/odometry_fusion/odometry_fusion.hpp"

namespace panvo::odometry_fusion {
namespace {

constexpr double kFarthest_s = 0.5;  // in which a car changes its speed by a few m/s

}  // namespace

/// In two legs, as wheels measure less often than a gyroscope.
std::optional<FusedPose> OdometryFusion::predicted() const {
  const auto gyro_ns = gyro_.window.latest_ns();
  if (!latest_ || !gyro_ns) return std::nullopt;
  const std::int64_t to_ns = later(*gyro_ns, -filter_.learned()[kGyroClock]);
  if (to_ns <= latest_->stamp_ns || seconds(latest_->stamp_ns, to_ns) > kFarthest_s) return std::nullopt;
  MotionFilter ahead = filter_;
  FusedPose fused;
  if (latest_->is_standing && is_gyro_still(to_ns)) {
    ahead.begin_still(seconds(latest_->stamp_ns, to_ns));
    fused.is_standing = fused.uses_gyro = true;
  } else {
    fused = move_ahead(ahead, to_ns);
  }
  ahead.compose();
  fused.take_motion(ahead);
  fused.stamp_ns = to_ns;
  return fused;
}

FusedPose OdometryFusion::move_ahead(MotionFilter& ahead, std::int64_t to_ns) const {
  const auto leg = [&](std::int64_t from_ns, std::int64_t until_ns) {
    Interval now = interval(from_ns, until_ns);
    choose_sensors(now);
    return continue_blind(now, ahead);
  };
  const auto wheels_ns = wheels_.window.latest_ns();
  const std::int64_t rolled_ns = wheels_ns ? std::min(to_ns, later(*wheels_ns, -wheels_late_s_)) : latest_->stamp_ns;
  if (rolled_ns <= latest_->stamp_ns) return leg(latest_->stamp_ns, to_ns);
  FusedPose fused = leg(latest_->stamp_ns, rolled_ns);
  if (rolled_ns == to_ns) return fused;
  ahead.compose();
  const FusedPose last = leg(rolled_ns, to_ns);
  fused.uses_gyro &= last.uses_gyro;
  fused.is_reliable &= last.uses_gyro;
  return fused;
}

}  // namespace panvo::odometry_fusion
