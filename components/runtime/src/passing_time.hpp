// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

namespace panvo::runtime {

/// Time during a run: a clock (live); the stamps reached by the sources, if any; in replay without sources, the stamps
/// of handled messages. Thread-safe.
class PassingTime {
 public:
  enum class Pace { kTasks, kSources, kClock };

  PassingTime(Pace pace, std::function<std::int64_t()> clock) : pace_(pace), clock_(std::move(clock)) {}

  void follow_sources() { pace_ = Pace::kSources; }
  Pace pace() const noexcept { return pace_; }

  /// Advances to this stamp; never goes back.
  void reach(std::int64_t stamp_ns) {
    std::int64_t before_ns = reached_ns_;
    while (stamp_ns > before_ns && !reached_ns_.compare_exchange_weak(before_ns, stamp_ns)) {
    }
  }

  /// 0 before the first stamp.
  std::int64_t now_ns() const { return pace_ == Pace::kClock ? clock_() : reached_ns_.load(); }

  /// Arrival time of a message received now; nullopt if time is known only from the messages themselves.
  std::optional<std::int64_t> arrival_ns() const {
    if (pace_ == Pace::kTasks || (pace_ == Pace::kSources && reached_ns_ == 0)) return std::nullopt;
    return now_ns();
  }

 private:
  std::atomic<Pace> pace_;
  const std::function<std::int64_t()> clock_;
  std::atomic<std::int64_t> reached_ns_ = 0;
};

}  // namespace panvo::runtime
