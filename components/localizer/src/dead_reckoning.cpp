// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/dead_reckoning.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numbers>

namespace panvo::localizer {
namespace {

constexpr double kTiltRateRad = 0.02;  // per second
constexpr double kMaxTilt_rad = 0.05;
constexpr double kSlow = 3.0;  // multiple of the usual interval from which a step is a gap

/// Distance under constant acceleration, limited by that at constant speed.
double after(double seconds, double acceleration, double speed) {
  return std::min(0.5 * acceleration * seconds * seconds, speed * seconds);
}

}  // namespace

vision::Matrix6d DeadReckoning::step(double interval_s, bool is_reliable) {
  const bool is_gap = interval_s > std::max(gap_s_, kSlow * interval_.median_s());
  interval_.add(interval_s);
  if (is_reliable && !is_gap) {
    blind_s_ = 0.0;
    return vision::Matrix6d::Zero();
  }
  const vision::Matrix6d least = silence(interval_s);
  blind_s_ = is_reliable ? 0.0 : blind_s_ + interval_s;
  return least;
}

vision::Matrix6d DeadReckoning::silence(double seconds) const {
  return (variance_after(blind_s_ + seconds) - variance_after(blind_s_)).asDiagonal();
}

double way_sigma_m(const MotionPrior& prior, double seconds) {
  return after(seconds, prior.acceleration_m_s2, prior.speed_m_s);
}

double turn_sigma_rad(const MotionPrior& prior, double seconds) {
  return std::min(after(seconds, prior.turn_acceleration_rad_s2, prior.turn_rate_rad_s), std::numbers::pi);
}

vision::Vector6d DeadReckoning::variance_after(double seconds) const {
  const double way_m = way_sigma_m(prior_, seconds);
  const double turn_rad = turn_sigma_rad(prior_, seconds);
  const double tilt_rad = std::min(kTiltRateRad * seconds, kMaxTilt_rad);
  vision::Vector6d sigma;
  sigma << way_m, way_m, kClimb * way_m, tilt_rad, tilt_rad, turn_rad;
  return sigma.cwiseAbs2();
}

vision::Matrix6d at_least(const vision::Matrix6d& covariance, const vision::Matrix6d& least) {
  if (least.isZero(0.0)) return covariance;
  const Eigen::SelfAdjointEigenSolver<vision::Matrix6d> lacking(least - covariance);
  return covariance + vision::Matrix6d(lacking.eigenvectors() * lacking.eigenvalues().cwiseMax(0.0).asDiagonal() *
                                       lacking.eigenvectors().transpose());
}

}  // namespace panvo::localizer
