// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/yaw_bias_detector.hpp"

namespace panvo::localizer {

std::optional<YawBiasDetector::Stretch> YawBiasDetector::add(const Stretch& turn) {
  if (!turns_.empty() && turns_.back().from_ns == turn.from_ns) {
    turns_.back() = turn;
  } else {
    if (!turns_.empty() && turns_.back().to_ns != turn.from_ns) turns_.clear();
    turns_.push_back(turn);
  }
  while (static_cast<double>(turn.to_ns - turns_.front().from_ns) > window_s_ * 1e9 && turns_.size() > 1) {
    turns_.pop_front();
  }
  Stretch all = turns_.front();
  for (std::size_t i = 1; i < turns_.size(); ++i) {
    all.to_ns = turns_[i].to_ns;
    all.disagreement_rad += turns_[i].disagreement_rad;
    all.compass_rad += turns_[i].compass_rad;
    all.odometry_variance_rad2 += turns_[i].odometry_variance_rad2;
    all.compass_variance_rad2 += turns_[i].compass_variance_rad2;
  }
  const double spread = all.odometry_variance_rad2 + all.compass_variance_rad2;
  const bool leans = all.disagreement_rad * all.disagreement_rad > sigmas_ * sigmas_ * spread;
  return leans ? std::optional(all) : std::nullopt;
}

}  // namespace panvo::localizer
