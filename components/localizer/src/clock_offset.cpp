// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/clock_offset.hpp"

#include <cmath>

namespace panvo::localizer {
namespace {

constexpr double kDrift_s2 = 1e-10;      // per measurement: camera clocks drift by some 10 us per second
constexpr double kMinRateChange = 0.05;  // rad/s: below, noise of odometry dominates
constexpr double kOutlier = 4.0 * 4.0;   // squared standard deviations

}  // namespace

void ClockOffset::add(double disagreement_rad, double yaw_rate_change, double variance_rad2) {
  variance_s2_ += kDrift_s2;
  if (std::abs(yaw_rate_change) < kMinRateChange) return;
  // Stamps late by s show a turn that odometry saw s earlier: the turn between them is smaller by s * change of the
  // rate.
  const double slope = -yaw_rate_change;
  const double spread = slope * slope * variance_s2_ + variance_rad2;
  if (!(spread > 0.0) || disagreement_rad * disagreement_rad > kOutlier * spread) return;
  const double gain = variance_s2_ * slope / spread;
  estimate_s_ += gain * disagreement_rad;
  variance_s2_ -= gain * slope * variance_s2_;
}

std::int64_t ClockOffset::estimate_ns() const { return static_cast<std::int64_t>(std::llround(estimate_s_ * 1e9)); }

}  // namespace panvo::localizer
