// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

namespace panvo::runtime {

/// Schedules restarts of a failing component: after 0.1, 1 and 10 s; none after a fourth failure within a minute.
class RestartPlan {
 public:
  static constexpr std::size_t kMaxWithinWindow = 3;
  static constexpr std::int64_t kWindow_ns = 60'000'000'000;
  static constexpr std::int64_t kFirstDelay_ns = 100'000'000, kMaxDelay_ns = 10'000'000'000;

  /// Time of the restart after a failure at `now_ns`; nullopt: too many failures.
  std::optional<std::int64_t> failed(std::int64_t now_ns) {
    while (!failures_ns_.empty() && failures_ns_.front() + kWindow_ns <= now_ns) failures_ns_.pop_front();
    if (failures_ns_.size() >= kMaxWithinWindow) return std::nullopt;
    std::int64_t delay_ns = kFirstDelay_ns;
    for (std::size_t i = 0; i < failures_ns_.size(); ++i) delay_ns = std::min(10 * delay_ns, kMaxDelay_ns);
    failures_ns_.push_back(now_ns);
    return now_ns + delay_ns;
  }

 private:
  std::deque<std::int64_t> failures_ns_;  // within the window
};

}  // namespace panvo::runtime
