// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace panvo::aravis_camera {

/// Schedules software triggers at multiples of the period in host time, so that all cameras of a host are triggered
/// together without communicating. Missed triggers are skipped.
class SoftwareTrigger {
 public:
  explicit SoftwareTrigger(double rate_hz) : period_ns_(static_cast<std::int64_t>(1e9 / rate_hz)) {}

  /// Whether a trigger is due; true at most once per period.
  bool is_due(std::int64_t now_ns) {
    const std::int64_t period = now_ns / period_ns_;
    if (period == last_period_) return false;
    const bool is_first = last_period_ < 0;
    last_period_ = period;
    return !is_first;
  }
  std::int64_t until_due_ns(std::int64_t now_ns) const { return period_ns_ - now_ns % period_ns_; }

 private:
  std::int64_t period_ns_;
  std::int64_t last_period_ = -1;
};

}  // namespace panvo::aravis_camera
