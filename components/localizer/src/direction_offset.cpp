// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/direction_offset.hpp"

#include <algorithm>

#include "panvo/vision/angle.hpp"

namespace panvo::localizer {
namespace {

constexpr double kMinVariance_rad2 = 1e-6;  // 0.06 deg: play of the mounts

}  // namespace

void DirectionOffset::remember(double estimate_rad, double variance_rad2) {
  is_remembered_ = true;
  estimate_rad_ = vision::wrapped(estimate_rad);
  variance_rad2_ = variance_rad2;
}

void DirectionOffset::forget_memory() {
  is_remembered_ = false;
  estimate_rad_ = 0.0;
  variance_rad2_ = prior_variance_rad2_;
}

void DirectionOffset::add(double difference_rad, double variance_rad2) {
  is_measured_ = true;
  const double gain = variance_rad2_ / (variance_rad2_ + variance_rad2);
  estimate_rad_ += gain * vision::wrapped(difference_rad - estimate_rad_);
  estimate_rad_ = vision::wrapped(estimate_rad_);
  variance_rad2_ = std::max(std::min(kMinVariance_rad2, variance_rad2_), (1.0 - gain) * variance_rad2_);
}

void DirectionOffset::restart(double estimate_rad, double variance_rad2) {
  is_measured_ = true;
  estimate_rad_ = vision::wrapped(estimate_rad);
  variance_rad2_ = variance_rad2;
}

}  // namespace panvo::localizer
