// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/yaw_scale_filter.hpp"

#include <algorithm>
#include <cmath>

namespace panvo::localizer {
namespace {

constexpr double kMinTurn_rad = 0.02;        // below, other errors exceed the effect of a scale
constexpr double kMinScaleVariance = 1e-6;   // of the scale: the compass misses as much of a turn
constexpr double kScaleOutlier = 4.0 * 4.0;  // squared standard deviations

}  // namespace

void YawScaleFilter::add(double disagreement_rad, double turn_rad, double variance_rad2) {
  if (std::abs(turn_rad) < kMinTurn_rad) return;
  const double slope = -turn_rad;  // odometry that turns more disagrees in the opposite direction
  const double spread = slope * slope * variance_ + variance_rad2;
  if (!(spread > 0.0) || disagreement_rad * disagreement_rad > kScaleOutlier * spread) return;
  const double gain = variance_ * slope / spread;
  estimate_ += gain * disagreement_rad;
  variance_ = std::max(std::min(kMinScaleVariance, variance_), variance_ - gain * slope * variance_);
}

}  // namespace panvo::localizer
