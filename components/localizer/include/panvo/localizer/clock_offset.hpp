// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace panvo::localizer {

/// By how much the panoramic camera's clock is ahead of the stereo camera's. Both see the vehicle turn; while it turns faster and
/// faster, or slower and slower, a clock that is off makes them disagree, in proportion to the change of the yaw rate. A Kalman
/// filter of one state.
class ClockOffset {
 public:
  /// `sigma_s`: how far off clocks may be before anything is known.
  explicit ClockOffset(double sigma_s) : variance_s2_(sigma_s * sigma_s) {}

  /// `disagreement_rad`: turn by the panoramas minus turn by the odometry between the same two times, when the stamps are taken
  /// to be off by estimate_s(); `yaw_rate_change`: of the odometry between these times, rad/s; `variance_rad2`: of the disagreement, were the
  /// clocks right.
  void add(double disagreement_rad, double yaw_rate_change, double variance_rad2);

  double estimate_s() const noexcept { return estimate_s_; }
  double variance_s2() const noexcept { return variance_s2_; }
  /// To be subtracted from a panorama's stamp.
  std::int64_t estimate_ns() const;

 private:
  double estimate_s_ = 0.0;
  double variance_s2_;
};

}  // namespace panvo::localizer
