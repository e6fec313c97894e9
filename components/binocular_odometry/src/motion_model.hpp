// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "panvo/vision/pose.hpp"

namespace panvo::binocular_odometry {

/// Constant velocity: what the camera did last, it goes on doing. At rest until told otherwise.
class MotionModel {
 public:
  /// Takes over a measured motion that lasted duration_ns (> 0).
  void update(const Eigen::Isometry3d& current_from_previous, std::int64_t duration_ns) {
    // Stamps that tell when an image came, not when it was taken, may lie a millisecond apart: no motion was so fast. The shorter of
    // two intervals, as one of them may hold frames that were lost.
    const std::int64_t usual_ns = before_last_ns_ == 0 ? last_ns_ : std::min(last_ns_, before_last_ns_);
    const auto least_ns = static_cast<std::int64_t>(kLeastOfUsual * static_cast<double>(usual_ns));
    velocity_ = vision::se3_log(current_from_previous) / seconds(std::max(duration_ns, least_ns));
    farthest_ns_ = last_ns_ == 0 ? kMostOfFirst * duration_ns : std::numeric_limits<std::int64_t>::max();
    before_last_ns_ = std::exchange(last_ns_, duration_ns);
  }

  /// Motion over the next duration_ns (> 0).
  Eigen::Isometry3d predict(std::int64_t duration_ns) const { return vision::se3_exp(twist(duration_ns)); }

  /// The same as a constant twist, which may be more than half a turn.
  vision::Vector6d twist(std::int64_t duration_ns) const {
    return velocity_ * seconds(std::min(duration_ns, farthest_ns_));
  }

 private:
  static constexpr double kLeastOfUsual = 0.5;  // of the time between frames
  static constexpr int kMostOfFirst = 2;        // times the first motion, with none before it to judge it by

  static double seconds(std::int64_t duration_ns) { return 1e-9 * static_cast<double>(duration_ns); }

  vision::Vector6d velocity_ = vision::Vector6d::Zero();
  std::int64_t last_ns_ = 0, before_last_ns_ = 0;
  std::int64_t farthest_ns_ = std::numeric_limits<std::int64_t>::max();
};

}  // namespace panvo::binocular_odometry
