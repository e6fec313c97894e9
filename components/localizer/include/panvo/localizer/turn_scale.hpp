// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace panvo::localizer {

/// By what share odometry turns more than the vehicle does. A focal length or a lens's distortion that is off makes all turns larger or
/// smaller in the same proportion, and the stereo pair cannot see it; a panorama has no focal length. A Kalman filter of one state.
class TurnScale {
 public:
  /// `sigma`: what it may be before anything is known.
  explicit TurnScale(double sigma) : variance_(sigma * sigma) {}

  /// `disagreement_rad`: turn by the panoramas minus turn by the odometry between the same two times, the odometry's put right by
  /// estimate(); `turn_rad`: that of the odometry; `variance_rad2`: of the disagreement, were the scale right.
  void add(double disagreement_rad, double turn_rad, double variance_rad2);

  /// 0.003: odometry turns by 0.3 % more than the vehicle.
  double estimate() const noexcept { return estimate_; }
  double variance() const noexcept { return variance_; }

 private:
  double estimate_ = 0.0;
  double variance_;
};

}  // namespace panvo::localizer
