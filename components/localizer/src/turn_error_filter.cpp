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
// 0.002 px, it lasts for 3.5 times the distance at which the disparity is one pixel.
constexpr double kLastingTurn_rad = 0.007;
constexpr double kTurnOutlier = 4.0 * 4.0;  // squared standard deviations

}  // namespace

TurnErrorFilter::TurnErrorFilter(double scale_sigma, double lean_sigma_rad_m)
    : scale_sigma_(scale_sigma),
      lean_sigma_rad_m_(lean_sigma_rad_m),
      covariance_(Eigen::Vector2d(scale_sigma * scale_sigma, lean_sigma_rad_m * lean_sigma_rad_m).asDiagonal()) {}

void TurnErrorFilter::expect_lean(double sigma_rad_m) {
  lean_sigma_rad_m_ = sigma_rad_m;
  if (!has_learned_) covariance_(1, 1) = sigma_rad_m * sigma_rad_m;
}

void TurnErrorFilter::expect_scale(double scale, double sigma) {
  if (has_learned_) return;
  state_[0] = scale;
  scale_sigma_ = sigma;
  covariance_(0, 0) = sigma * sigma;
}

std::optional<Estimate> TurnErrorFilter::measured_scale() const {
  if (!has_learned_ || 2.0 * covariance_(0, 0) > scale_sigma_ * scale_sigma_) return std::nullopt;
  return Estimate{state_[0], std::sqrt(covariance_(0, 0))};
}

TurnErrorChange TurnErrorFilter::add(double disagreement_rad, double turn_rad, double way_m, double variance_rad2) {
  if (std::abs(turn_rad) < kMinTurn_rad && way_m < kMinWay_m) return {};
  has_learned_ = true;
  if (unlearned_m_ > way_m) change_lean(unlearned_m_ - way_m);
  covariance_(1, 1) += walk_per_m() * way_m;
  unlearned_m_ = 0.0;
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

/// On a way without measurements, what is unknown of the lean becomes independent of what is unknown of the scale.
void TurnErrorFilter::change_lean(double way_m) {
  const double variance = lean_variance_after(way_m);
  covariance_(0, 1) = covariance_(1, 0) = covariance_(0, 1) * lean_same_after(way_m);
  covariance_(1, 1) = variance;
}

double TurnErrorFilter::advance(double way_m) {
  unlearned_m_ += way_m;
  unseen_m_ += way_m;
  if (!has_learned_ || !(lean_memory_m() > 0.0)) return 0.0;
  const double memory_m = lean_memory_m();
  const double as_if_learning =
      2.0 * covariance_(1, 1) * memory_m * (unseen_m_ + memory_m * std::expm1(-unseen_m_ / memory_m));
  const double more = std::max(0.0, heading_variance_after(unseen_m_) - as_if_learning - told_rad2_);
  told_rad2_ += more;
  return more;
}

/// Without measurements, the lean is a Gauss-Markov process. Its best prediction would decrease to zero; but where a
/// calibration has aged, some of the lean never ends. So the estimate is kept, and what that costs is part of its error.
double TurnErrorFilter::lean_variance_after(double way_m) const {
  const double same = lean_same_after(way_m);
  return same * same * covariance_(1, 1) + (1.0 - same * same) * std::pow(lean_sigma_rad_m_, 2) +
         std::pow((1.0 - same) * state_[1], 2);
}

/// The part of the lean that is as before.
double TurnErrorFilter::lean_same_after(double way_m) const {
  return lasting_m() > 0.0 ? std::exp(-way_m / lasting_m()) : 1.0;
}

/// Of what it has turned on this way.
double TurnErrorFilter::heading_variance_after(double way_m) const {
  const double memory_m = lasting_m();
  const double other = -std::expm1(-way_m / memory_m), same = 1.0 - other;
  const double of_change = 2.0 * way_m / memory_m - 3.0 + 4.0 * same - same * same;
  return memory_m * memory_m * (covariance_(1, 1) * other * other + std::pow(lean_sigma_rad_m_, 2) * of_change) +
         std::pow(state_[1] * (way_m - memory_m * other), 2);
}

/// The lean is forgotten and learned at the same rate, in the long run.
double TurnErrorFilter::lean_memory_m() const { return walk_per_m() > 0.0 ? covariance_(1, 1) / walk_per_m() : 0.0; }

/// Variance by which the lean changes.
double TurnErrorFilter::walk_per_m() const { return std::pow(lean_sigma_rad_m_, 3) / kLastingTurn_rad; }

/// After this way, the lean is another one.
double TurnErrorFilter::lasting_m() const {
  return lean_sigma_rad_m_ > 0.0 ? kLastingTurn_rad / lean_sigma_rad_m_ : 0.0;
}

}  // namespace panvo::localizer
