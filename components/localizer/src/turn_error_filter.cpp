// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/turn_error_filter.hpp"

#include <algorithm>
#include <cmath>

namespace panvo::localizer {
namespace {

constexpr double kMinTurn_rad = 0.02, kMinWay_m = 0.5;  // below both, other errors exceed their effect
constexpr double kMinScaleVariance = 1e-6;              // the compass misses as much of a turn
// What a lean turns until it is another one. It lasts while the same points are in view, and a camera with a smaller
// baseline or focal length leans more, but measures only nearer ones: both by the same factor. With a disparity error of
// 0.007 px, it lasts for the distance at which the disparity is one pixel.
constexpr double kLastingTurn_rad = 0.007;
constexpr double kTurnOutlier = 4.0 * 4.0;  // squared standard deviations

}  // namespace

TurnErrorFilter::TurnErrorFilter(double scale_sigma, double lean_sigma_rad_m)
    : lean_sigma_rad_m_(lean_sigma_rad_m),
      covariance_(Eigen::Vector2d(scale_sigma * scale_sigma, lean_sigma_rad_m * lean_sigma_rad_m).asDiagonal()) {}

void TurnErrorFilter::expect_lean(double sigma_rad_m) {
  if (has_learned_) return;
  lean_sigma_rad_m_ = sigma_rad_m;
  covariance_(1, 1) = sigma_rad_m * sigma_rad_m;
}

TurnErrorChange TurnErrorFilter::add(double disagreement_rad, double turn_rad, double way_m, double variance_rad2) {
  if (std::abs(turn_rad) < kMinTurn_rad && way_m < kMinWay_m) return {};
  has_learned_ = true;
  covariance_(1, 1) += walk_per_m() * way_m;
  const Eigen::Vector2d slope(-turn_rad, -way_m);  // odometry that turns more disagrees in the opposite direction
  const double spread = slope.dot(covariance_ * slope) + variance_rad2;
  if (!(spread > 0.0) || disagreement_rad * disagreement_rad > kTurnOutlier * spread) return {};
  const double memory_m = lean_memory_m();
  const Eigen::Vector2d gain = covariance_ * slope / spread;
  const double least = std::min(kMinScaleVariance, covariance_(0, 0));
  const Eigen::Vector2d change = gain * disagreement_rad;
  state_ += change;
  covariance_ -= gain * spread * gain.transpose();
  // Raising a variance leaves the matrix positive semidefinite.
  covariance_(0, 0) = std::max(covariance_(0, 0), least);
  return {change[0], change[1], memory_m};
}

/// The lean is forgotten and learned at the same rate, in the long run.
double TurnErrorFilter::lean_memory_m() const { return walk_per_m() > 0.0 ? covariance_(1, 1) / walk_per_m() : 0.0; }

/// Variance by which the lean changes.
double TurnErrorFilter::walk_per_m() const { return std::pow(lean_sigma_rad_m_, 3) / kLastingTurn_rad; }

}  // namespace panvo::localizer
