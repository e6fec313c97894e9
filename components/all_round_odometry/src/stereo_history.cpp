// SPDX-License-Identifier: Apache-2.0
#include "panvo/all_round_odometry/stereo_history.hpp"

#include <algorithm>
#include <iterator>

#include "panvo/vision/seconds.hpp"

namespace panvo::all_round_odometry {
namespace {

constexpr double kMaxGap_s = 0.5;  // between two poses: a vehicle may turn within a longer one

using vision::seconds;

}  // namespace

std::size_t StereoHistory::first_from(std::int64_t stamp_ns) const {
  const auto found = std::ranges::lower_bound(poses_, stamp_ns, {}, &StereoPose::stamp_ns);
  return static_cast<std::size_t>(std::distance(poses_.begin(), found));
}

std::optional<Pose> StereoHistory::at(std::int64_t stamp_ns) const {
  const std::size_t after = first_from(stamp_ns);
  if (after == poses_.size()) return std::nullopt;
  const StereoPose& b = poses_[after];
  if (b.stamp_ns == stamp_ns) return Pose{b.odom_from_base, b.covariance};
  if (after == 0) return std::nullopt;
  const StereoPose& a = poses_[after - 1];
  if (seconds(a.stamp_ns, b.stamp_ns) > kMaxGap_s) return std::nullopt;
  const double share = seconds(a.stamp_ns, stamp_ns) / seconds(a.stamp_ns, b.stamp_ns);
  return Pose{vision::interpolate(a.odom_from_base, b.odom_from_base, share),
              (1.0 - share) * a.covariance + share * b.covariance};
}

std::optional<Eigen::Isometry3d> StereoHistory::measured(std::int64_t from_ns, std::int64_t to_ns) const {
  const auto from = at(from_ns), to = at(to_ns);
  if (!from || !to || from_ns >= to_ns) return std::nullopt;
  const std::size_t last = first_from(to_ns);
  for (std::size_t i = first_from(from_ns + 1); i <= last; ++i) {
    if (!poses_[i].is_reliable || seconds(poses_[i - 1].stamp_ns, poses_[i].stamp_ns) > kMaxGap_s) return std::nullopt;
  }
  return from->odom_from_base.inverse() * to->odom_from_base;
}

}  // namespace panvo::all_round_odometry
