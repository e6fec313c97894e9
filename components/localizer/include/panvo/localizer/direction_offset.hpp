// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace panvo::localizer {

/// By what angle the panoramas see the vehicle drive farther to the left than odometry does, all the time: one of the cameras is turned on its
/// mount. A Kalman filter of one state.
class DirectionOffset {
 public:
  /// `sigma_rad`: what it may be before anything is known.
  explicit DirectionOffset(double sigma_rad) : variance_rad2_(sigma_rad * sigma_rad) {}

  /// `difference_rad`: direction of the way by the panoramas minus that by the odometry, both in the vehicle's axes; `variance_rad2`: of it, were
  /// both cameras mounted as is said.
  void add(double difference_rad, double variance_rad2);

  /// It is another one by now.
  void restart(double estimate_rad, double variance_rad2);

  bool is_measured() const noexcept { return is_measured_; }
  double estimate_rad() const noexcept { return estimate_rad_; }
  double variance_rad2() const noexcept { return variance_rad2_; }

 private:
  bool is_measured_ = false;
  double estimate_rad_ = 0.0;
  double variance_rad2_;
};

}  // namespace panvo::localizer
