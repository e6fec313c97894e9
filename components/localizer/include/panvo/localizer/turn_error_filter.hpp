// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "panvo/localizer/estimate.hpp"

namespace panvo::localizer {

/// Uncertainty of the systematic errors of odometry's turns.
struct TurnErrors {
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of a share of each turn, and of a lean per metre
  double lean_memory_m = 0.0;                            ///< after this way, the error of the lean is another one
};

/// By how much a measurement changed the estimates, which also concerns the path so far.
struct TurnErrorChange {
  double scale = 0.0, lean_rad_m = 0.0;
  double lean_memory_m = 0.0;  ///< the lean so far back was another one; 0: it does not change
};

/// Systematic error of odometry's turns, which the compass shows: a share of each turn, as of an error of focal length
/// or distortion, which the stereo pair does not notice and a panorama does not have; and a lean per metre, as of an
/// error of the rectification, which changes slowly with the scene. Kalman filter with two states.
class TurnErrorFilter {
 public:
  /// Prior standard deviations.
  TurnErrorFilter(double scale_sigma, double lean_sigma_rad_m);

  /// Standard deviation of the lean from now on, such as in rain. Before the first measurement it replaces the prior;
  /// later the lean changes as such a lean does.
  void expect_lean(double sigma_rad_m);

  /// Replaces the prior of the scale, before the first measurement only.
  void expect_scale(double scale, double sigma);

  /// `disagreement_rad`: turn by panoramas minus turn by odometry between the same two times, the latter corrected by
  /// error_rad(); `turn_rad`, `way_m`: by odometry; `variance_rad2`: of the disagreement of exact odometry.
  TurnErrorChange add(double disagreement_rad, double turn_rad, double way_m, double variance_rad2);

  /// Moves on by a step of the odometry. Returns the variance of the heading that the change of the lean since the last
  /// measurement adds to covariance_of_turns() with errors(), rad^2.
  double advance(double way_m);
  /// The compass measured the turn up to here: the error of the lean accumulates from zero again.
  void measure_turn() { unseen_m_ = told_rad2_ = 0.0; }

  /// What odometry turns too much on a step.
  double error_rad(double turn_rad, double way_m) const noexcept { return state_[0] * turn_rad + state_[1] * way_m; }
  /// 0.003: odometry turns 0.3 % more than the vehicle.
  double scale() const noexcept { return state_[0]; }
  /// The same once measurements have halved its variance.
  std::optional<Estimate> measured_scale() const;
  double lean_rad_m() const noexcept { return state_[1]; }
  const Eigen::Matrix2d& covariance() const noexcept { return covariance_; }
  TurnErrors errors() const { return {covariance_, lean_memory_m()}; }

 private:
  double walk_per_m() const;
  double lean_memory_m() const;
  double lasting_m() const;
  void change_lean(double way_m);
  double lean_same_after(double way_m) const;
  double lean_variance_after(double way_m) const;
  double heading_variance_after(double way_m) const;

  double scale_sigma_, lean_sigma_rad_m_;
  bool has_learned_ = false;
  double unlearned_m_ = 0.0;                         // way since the last measurement
  double unseen_m_ = 0.0;                            // way since the last turn that the compass measured
  double told_rad2_ = 0.0;                           // sum of what advance() returned on it
  Eigen::Vector2d state_ = Eigen::Vector2d::Zero();  // scale, lean
  Eigen::Matrix2d covariance_;
};

}  // namespace panvo::localizer
