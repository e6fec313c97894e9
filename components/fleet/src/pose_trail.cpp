// SPDX-License-Identifier: Apache-2.0
#include "panvo/fleet/pose_trail.hpp"

#include <algorithm>

namespace panvo::fleet {
namespace {

constexpr double kMaxStep_s = 1.0;  // a longer pause is no motion at the speed after it

}  // namespace

void PoseTrail::add(std::int64_t stamp_ns, const Eigen::Isometry3d& map_from_base, const vision::Matrix6d& covariance,
                    double speed_m_per_s) {
  const auto order = stamps_.add(stamp_ns);
  if (order == vision::StampOrder::kNotLater) return;
  double travelled_m = 0.0;
  if (!samples_.empty()) {
    // negative if the clock was set back
    const double step_s = 1e-9 * static_cast<double>(stamp_ns - samples_.back().stamp_ns);
    travelled_m = samples_.back().travelled_m + speed_m_per_s * std::clamp(step_s, 0.0, kMaxStep_s);
  }
  if (order == vision::StampOrder::kSetBack) samples_.clear();
  samples_.push_back({stamp_ns, map_from_base, covariance, travelled_m});
  if (samples_.size() > kMaxSamples) samples_.pop_front();
}

std::optional<PoseSample> PoseTrail::at(std::int64_t stamp_ns) const {
  const auto after =
      std::lower_bound(samples_.begin(), samples_.end(), stamp_ns,
                       [](const PoseSample& sample, std::int64_t stamp) { return sample.stamp_ns < stamp; });
  if (after == samples_.end()) return std::nullopt;
  if (after->stamp_ns == stamp_ns) return *after;
  if (after == samples_.begin()) return std::nullopt;
  const auto& before = *std::prev(after);
  const double share =
      static_cast<double>(stamp_ns - before.stamp_ns) / static_cast<double>(after->stamp_ns - before.stamp_ns);
  PoseSample sample = *after;
  sample.stamp_ns = stamp_ns;
  sample.map_from_base = vision::interpolate(before.map_from_base, after->map_from_base, share);
  sample.travelled_m = before.travelled_m + share * (after->travelled_m - before.travelled_m);
  return sample;
}

}  // namespace panvo::fleet
