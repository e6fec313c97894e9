// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace panvo::localizer {

/// Angle by which panoramas see the driving direction farther left than odometry, i.e. an error of a camera's mounting.
/// One-state Kalman filter.
class DirectionOffset {
 public:
  /// `sigma_rad`: prior standard deviation.
  explicit DirectionOffset(double sigma_rad) : variance_rad2_(sigma_rad * sigma_rad) {}

  /// `difference_rad`: direction of motion by panoramas minus that by odometry, both in the vehicle's axes;
  /// `variance_rad2`: its variance for exact extrinsics.
  void add(double difference_rad, double variance_rad2);

  /// Restarts with a new value.
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
