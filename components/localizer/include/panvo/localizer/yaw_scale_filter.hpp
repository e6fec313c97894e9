// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace panvo::localizer {

/// Relative excess of odometry's turns. An error of focal length or distortion scales all turns, unnoticed by the
/// stereo pair; a panorama has no focal length. One-state Kalman filter.
class YawScaleFilter {
 public:
  /// `sigma`: prior standard deviation.
  explicit YawScaleFilter(double sigma) : variance_(sigma * sigma) {}

  /// `disagreement_rad`: turn by panoramas minus turn by odometry between the same two times, the latter corrected by
  /// estimate(); `turn_rad`: turn by odometry; `variance_rad2`: of the disagreement for an exact scale.
  void add(double disagreement_rad, double turn_rad, double variance_rad2);

  /// 0.003: odometry turns 0.3 % more than the vehicle.
  double estimate() const noexcept { return estimate_; }
  double variance() const noexcept { return variance_; }

 private:
  double estimate_ = 0.0;
  double variance_;
};

}  // namespace panvo::localizer
