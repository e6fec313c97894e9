// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "panvo/vision/pose.hpp"

namespace panvo::binocular_odometry {

/// Constant-velocity model of the camera motion; initially at rest.
class MotionModel {
 public:
  /// Updates the velocity from a measured motion of duration_ns (> 0).
  void update(const Eigen::Isometry3d& current_from_previous, std::int64_t duration_ns) {
    // Arrival stamps may be only a millisecond apart, which would give an implausible velocity: assume at least half of
    // the usual interval, the shorter of the last two (one of them may contain lost frames).
    const std::int64_t usual_ns = before_last_ns_ == 0 ? last_ns_ : std::min(last_ns_, before_last_ns_);
    const auto min_ns = static_cast<std::int64_t>(kMinOfUsual * static_cast<double>(usual_ns));
    velocity_ = vision::se3_log(current_from_previous) / seconds(std::max(duration_ns, min_ns));
    max_ns_ = last_ns_ == 0 ? kMaxOfFirst * duration_ns : std::numeric_limits<std::int64_t>::max();
    before_last_ns_ = std::exchange(last_ns_, duration_ns);
  }

  /// Motion over the next duration_ns (> 0).
  Eigen::Isometry3d predict(std::int64_t duration_ns) const { return vision::se3_exp(twist(duration_ns)); }

  /// The same motion as a constant twist; its rotation may exceed half a turn.
  vision::Vector6d twist(std::int64_t duration_ns) const { return velocity_ * seconds(std::min(duration_ns, max_ns_)); }

 private:
  static constexpr double kMinOfUsual = 0.5;  // of the usual time between frames
  static constexpr int kMaxOfFirst = 2;  // limit of extrapolation from the first motion, in multiples of its duration

  static double seconds(std::int64_t duration_ns) { return 1e-9 * static_cast<double>(duration_ns); }

  vision::Vector6d velocity_ = vision::Vector6d::Zero();
  std::int64_t last_ns_ = 0, before_last_ns_ = 0;
  std::int64_t max_ns_ = std::numeric_limits<std::int64_t>::max();
};

}  // namespace panvo::binocular_odometry
