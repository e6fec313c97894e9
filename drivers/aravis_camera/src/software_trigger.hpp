// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace panvo::aravis_camera {

/// When a software trigger is due: at the multiples of its period, so that the cameras of one host are triggered together without knowing of each
/// other. A trigger that was missed is left out, not made up for.
class SoftwareTrigger {
 public:
  explicit SoftwareTrigger(double rate_hz) : period_ns_(static_cast<std::int64_t>(1e9 / rate_hz)) {}

  /// Whether it is time; once for each period.
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
