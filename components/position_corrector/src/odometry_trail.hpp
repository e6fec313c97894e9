// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "panvo/position_corrector/landmark_matcher.hpp"
#include "panvo/vision/pose.hpp"
#include "panvo/vision/stamp_sequence.hpp"

namespace panvo::position_corrector {

/// Content of one odometry message.
struct OdometrySample {
  std::int64_t stamp_ns = 0;
  PositionPrior prior;
  vision::Vector6d twist =
      vision::Vector6d::Zero();  ///< of base_link in its own axes, m/s, rad/s: mean since the previous message
};

/// Position, motion and path length of the vehicle at a stamp.
struct TrailPoint {
  PositionPrior prior;
  vision::Vector6d twist = vision::Vector6d::Zero();
  double travelled_m = 0.0;
};

/// Recent odometry, for panoramas that arrive late. Path length is the integral of the speed, as corrected positions
/// jump.
class OdometryTrail {
 public:
  /// Ignores messages whose stamp is not later than the last. If the clock was set back, only the path length goes on.
  void add(const OdometrySample& sample);

  /// Interpolated between the two messages around a stamp; clamped to the first and last message. nullopt before the
  /// first message.
  std::optional<TrailPoint> at(std::int64_t stamp_ns) const;

 private:
  static constexpr std::size_t kMaxSamples = 200;  // 8 s at 25 Hz

  struct Entry {
    std::int64_t stamp_ns;
    TrailPoint point;
  };
  vision::StampSequence stamps_;
  std::deque<Entry> entries_;
};

}  // namespace panvo::position_corrector
