// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/yaw_bias_detector.hpp"

#include <utility>

namespace panvo::localizer {

void YawBiasDetector::take(const Stretch& turn) {
  if (!turns_.empty() && turns_.back().from_ns == turn.from_ns) {
    turns_.back() = turn;
  } else {
    const bool is_next = !turns_.empty() && turns_.back().to_ns == turn.from_ns;
    if (!is_next) turns_.clear();
    is_corrected_ = is_next && is_biased_;
    turns_.push_back(turn);
  }
  while (static_cast<double>(turn.to_ns - turns_.front().from_ns) > window_s_ * 1e9 && turns_.size() > 1) {
    turns_.pop_front();
  }
}

/// If the whole of a sliding stretch were corrected each time, its older part would be turned again and again.
std::optional<YawBiasDetector::Bias> YawBiasDetector::add(const Stretch& turn) {
  take(turn);
  Stretch all = turns_.front();
  for (std::size_t i = 1; i < turns_.size(); ++i) {
    all.to_ns = turns_[i].to_ns;
    all.disagreement_rad += turns_[i].disagreement_rad;
    all.compass_rad += turns_[i].compass_rad;
    all.odometry_variance_rad2 += turns_[i].odometry_variance_rad2;
    all.compass_variance_rad2 += turns_[i].compass_variance_rad2;
  }
  const double spread = all.odometry_variance_rad2 + all.compass_variance_rad2;
  const double squared = all.disagreement_rad * all.disagreement_rad;
  is_biased_ = squared > sigmas_ * sigmas_ * spread;
  if (!is_biased_) return std::nullopt;
  return Bias{std::exchange(is_corrected_, true) ? turn : all, squared / all.odometry_variance_rad2};
}

}  // namespace panvo::localizer
