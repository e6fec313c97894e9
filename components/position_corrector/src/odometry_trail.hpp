// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "panvo/position_corrector/landmark_matcher.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::position_corrector {

/// What one odometry message says.
struct OdometrySample {
  std::int64_t stamp_ns = 0;
  PositionPrior prior;
  vision::Vector6d twist =
      vision::Vector6d::Zero();  ///< of base_link in its own axes, m/s, rad/s: mean since the one before
};

/// Where the vehicle was at a stamp, how it moved, and how far it had driven by then.
struct TrailPoint {
  PositionPrior prior;
  vision::Vector6d twist = vision::Vector6d::Zero();
  double travelled_m = 0.0;
};

/// The last seconds of odometry, for panoramas that come later than their stamps. The way is the integral of the speed: a
/// position that is corrected jumps, and a jump is no way. A speed does not jump.
class OdometryTrail {
 public:
  /// One whose stamp is not after the last is left out.
  void add(const OdometrySample& sample);

  /// At a stamp: between the two messages around it; of the nearest one before the first and after the last. Nothing before
  /// the first message of all.
  std::optional<TrailPoint> at(std::int64_t stamp_ns) const;

 private:
  static constexpr std::size_t kMost = 200;  // 8 s at 25 Hz

  struct Entry {
    std::int64_t stamp_ns;
    TrailPoint point;
  };
  std::deque<Entry> entries_;
};

}  // namespace panvo::position_corrector
