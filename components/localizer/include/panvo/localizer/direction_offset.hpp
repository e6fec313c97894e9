// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace panvo::localizer {

/// Angle by which panoramas see the driving direction farther left than odometry, i.e. an error of a camera's mounting.
/// One-state Kalman filter. What an earlier journey found is its prior, unless it is forgotten for that of the parameters.
class DirectionOffset {
 public:
  /// `sigma_rad`: prior standard deviation.
  explicit DirectionOffset(double sigma_rad)
      : prior_variance_rad2_(sigma_rad * sigma_rad), variance_rad2_(sigma_rad * sigma_rad) {}

  /// Begins with that of an earlier journey. Before the first measurement.
  void remember(double estimate_rad, double variance_rad2);
  /// Of another mounting: begins without it. Precondition: is_only_remembered()
  void forget_memory();
  bool is_only_remembered() const noexcept { return is_remembered_ && !is_measured_; }

  /// `difference_rad`: direction of motion by panoramas minus that by odometry, both in the vehicle's axes;
  /// `variance_rad2`: its variance for exact extrinsics.
  void add(double difference_rad, double variance_rad2);

  /// Restarts with a new value.
  void restart(double estimate_rad, double variance_rad2);

  bool is_measured() const noexcept { return is_measured_; }
  double estimate_rad() const noexcept { return estimate_rad_; }
  double variance_rad2() const noexcept { return variance_rad2_; }

 private:
  double prior_variance_rad2_;
  bool is_remembered_ = false;
  bool is_measured_ = false;
  double estimate_rad_ = 0.0;
  double variance_rad2_;
};

}  // namespace panvo::localizer
