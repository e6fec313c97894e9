// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

namespace panvo::runtime {

/// Histogram of durations with 2 % bins from 1 us to about 500 s: quantiles of a run of any length in fixed memory.
class DurationHistogram {
 public:
  void add(std::int64_t duration_ns) noexcept;

  std::uint64_t count() const noexcept { return count_; }
  double mean_ms() const noexcept;
  double max_ms() const noexcept { return static_cast<double>(max_ns_) * 1e-6; }
  /// Quantile, accurate to 2 %; 0 if empty. `fraction` in [0, 1].
  double quantile_ms(double fraction) const noexcept;

 private:
  static constexpr std::size_t kBins = 1024;
  std::array<std::uint32_t, kBins> bins_{};
  std::uint64_t count_ = 0;
  std::int64_t sum_ns_ = 0;
  std::int64_t max_ns_ = 0;
};

/// Wall and CPU time of each stage of a component. Thread-safe.
class StageTimes {
 public:
  struct Times {
    DurationHistogram wall, cpu;
  };

  void add(std::string_view stage, std::int64_t wall_ns, std::int64_t cpu_ns);
  /// In order of name.
  std::map<std::string, Times, std::less<>> snapshot() const;

 private:
  mutable std::mutex mutex_;
  std::map<std::string, Times, std::less<>> stages_;
};

/// Stage times by component and stage.
using ComponentTimes = std::map<std::string, std::map<std::string, StageTimes::Times, std::less<>>>;

/// Measures wall time and this thread's CPU time from construction to destruction and adds them to a stage.
class StageTimer {
 public:
  StageTimer(StageTimes& times, std::string_view stage) noexcept;
  ~StageTimer();
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  StageTimes& times_;
  std::string stage_;
  std::int64_t wall_start_ns_;
  std::int64_t cpu_start_ns_;
};

}  // namespace panvo::runtime
