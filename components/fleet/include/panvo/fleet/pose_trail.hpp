// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <optional>

#include "panvo/vision/pose.hpp"
#include "panvo/vision/stamp_sequence.hpp"

namespace panvo::fleet {

/// Pose of the vehicle in the own map.
struct PoseSample {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Identity();
  double travelled_m = 0.0;  ///< path since the start: the integral of the speed, as corrected poses jump
};

/// Recent poses, for panoramas that come earlier or later than the pose of their stamp.
class PoseTrail {
 public:
  /// `speed_m_per_s`: mean since the previous pose. A pose that is not later than the last one is ignored. If the
  /// clock was set back, only the path length goes on.
  void add(std::int64_t stamp_ns, const Eigen::Isometry3d& map_from_base, const vision::Matrix6d& covariance,
           double speed_m_per_s);

  /// Interpolated; nullopt before the first pose and after the last one.
  std::optional<PoseSample> at(std::int64_t stamp_ns) const;
  const PoseSample* latest() const { return samples_.empty() ? nullptr : &samples_.back(); }

 private:
  static constexpr std::size_t kMaxSamples = 250;  // 10 s at 25 Hz

  vision::StampSequence stamps_;
  std::deque<PoseSample> samples_;
};

}  // namespace panvo::fleet
