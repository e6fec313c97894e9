// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace panvo::localizer {

/// Offset by which the panoramic camera's clock is ahead of the stereo camera's. Both see the vehicle turn; with a
/// clock offset, their turns differ in proportion to the change of the yaw rate. One-state Kalman filter.
class ClockOffset {
 public:
  /// `sigma_s`: prior standard deviation.
  explicit ClockOffset(double sigma_s, double estimate_s = 0.0)
      : estimate_s_(estimate_s), variance_s2_(sigma_s * sigma_s) {}

  /// `disagreement_rad`: turn by panoramas minus turn by odometry between the same two times, with stamps corrected by
  /// estimate_s(); `yaw_rate_change`: of the odometry between these times, rad/s; `variance_rad2`: of the disagreement
  /// for exact clocks.
  void add(double disagreement_rad, double yaw_rate_change, double variance_rad2);

  double estimate_s() const noexcept { return estimate_s_; }
  double variance_s2() const noexcept { return variance_s2_; }
  /// Subtract it from a panorama's stamp.
  std::int64_t estimate_ns() const;

 private:
  double estimate_s_;
  double variance_s2_;
};

}  // namespace panvo::localizer
