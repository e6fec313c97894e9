// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

namespace panvo::runtime {

/// The time that passes while a container runs: live a clock; where something is played, the stamps that its sources have come to; in a replay
/// without sources, the stamps of what is handled. Safe to use from several threads.
class PassingTime {
 public:
  enum class Pace { kTasks, kSources, kClock };

  PassingTime(Pace pace, std::function<std::int64_t()> clock) : pace_(pace), clock_(std::move(clock)) {}

  void follow_sources() { pace_ = Pace::kSources; }
  Pace pace() const noexcept { return pace_; }

  /// What is played, or handled, has come to this stamp; time does not go back.
  void reach(std::int64_t stamp_ns) {
    std::int64_t before_ns = reached_ns_;
    while (stamp_ns > before_ns && !reached_ns_.compare_exchange_weak(before_ns, stamp_ns)) {
    }
  }

  /// 0 before anything was reached.
  std::int64_t now_ns() const { return pace_ == Pace::kClock ? clock_() : reached_ns_.load(); }

  /// When a message that comes now arrives; nullopt where nothing but the messages themselves tells time.
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
