// SPDX-License-Identifier: Apache-2.0
#include "odometry_trail.hpp"

#include <algorithm>
#include <iterator>

namespace panvo::position_corrector {

void OdometryTrail::add(const OdometrySample& sample) {
  const auto order = stamps_.add(sample.stamp_ns);
  if (order == vision::StampOrder::kNotLater) return;
  double travelled_m = 0.0;
  if (!entries_.empty()) {
    const auto& last = entries_.back();
    // Negative if the clock was set back: the path of the few messages until that is certain is unknown.
    const double seconds = std::max(1e-9 * static_cast<double>(sample.stamp_ns - last.stamp_ns), 0.0);
    travelled_m = last.point.travelled_m + sample.twist.head<3>().norm() * seconds;
  }
  if (order == vision::StampOrder::kSetBack) entries_.clear();
  entries_.push_back({sample.stamp_ns, {sample.prior, sample.twist, travelled_m}});
  if (entries_.size() > kMaxSamples) entries_.pop_front();
}

std::optional<TrailPoint> OdometryTrail::at(std::int64_t stamp_ns) const {
  if (entries_.empty()) return std::nullopt;
  const auto after = std::lower_bound(entries_.begin(), entries_.end(), stamp_ns,
                                      [](const Entry& entry, std::int64_t stamp) { return entry.stamp_ns < stamp; });
  if (after == entries_.end()) return entries_.back().point;
  if (after == entries_.begin() || after->stamp_ns == stamp_ns) return after->point;
  const auto before = std::prev(after);
  const double share =
      static_cast<double>(stamp_ns - before->stamp_ns) / static_cast<double>(after->stamp_ns - before->stamp_ns);
  TrailPoint point = after->point;
  point.prior.position = before->point.prior.position + share * (point.prior.position - before->point.prior.position);
  point.travelled_m = before->point.travelled_m + share * (point.travelled_m - before->point.travelled_m);
  return point;
}

}  // namespace panvo::position_corrector
