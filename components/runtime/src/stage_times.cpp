// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/stage_times.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace panvo::runtime {
namespace {

constexpr double kMinNs = 1000.0;                    // bin 0 holds all shorter durations
constexpr double kLogBinWidth = 0.0198026272961797;  // log(1.02)

std::int64_t now_ns(clockid_t clock) noexcept {
  timespec time{};
  clock_gettime(clock, &time);
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

}  // namespace

void DurationHistogram::add(std::int64_t duration_ns) noexcept {
  duration_ns = std::max<std::int64_t>(duration_ns, 0);
  std::size_t bin = 0;
  if (const auto ratio = static_cast<double>(duration_ns) / kMinNs; ratio >= 1.0) {
    bin = std::min(kBins - 1, 1 + static_cast<std::size_t>(std::log(ratio) / kLogBinWidth));
  }
  ++bins_[bin];
  ++count_;
  sum_ns_ += duration_ns;
  max_ns_ = std::max(max_ns_, duration_ns);
}

double DurationHistogram::mean_ms() const noexcept {
  return count_ == 0 ? 0.0 : static_cast<double>(sum_ns_) * 1e-6 / static_cast<double>(count_);
}

double DurationHistogram::quantile_ms(double fraction) const noexcept {
  if (count_ == 0) {
    return 0.0;
  }
  // Smallest duration not exceeded by at least this fraction of the samples.
  const double wanted = std::ceil(std::clamp(fraction, 0.0, 1.0) * static_cast<double>(count_));
  const auto rank = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(wanted));
  if (rank == count_) {
    return max_ms();
  }
  std::uint64_t counted = 0;
  std::size_t bin = 0;
  while ((counted += bins_[bin]) < rank) {
    ++bin;
  }
  const double middle_ns = kMinNs * std::exp((static_cast<double>(bin) - 0.5) * kLogBinWidth);
  return std::min(middle_ns * 1e-6, max_ms());
}

void StageTimes::add(std::string_view stage, std::int64_t wall_ns, std::int64_t cpu_ns) {
  const std::lock_guard lock(mutex_);
  auto found = stages_.find(stage);
  if (found == stages_.end()) {
    found = stages_.try_emplace(std::string(stage)).first;
  }
  found->second.wall.add(wall_ns);
  found->second.cpu.add(cpu_ns);
}

std::map<std::string, StageTimes::Times, std::less<>> StageTimes::snapshot() const {
  const std::lock_guard lock(mutex_);
  return stages_;
}

StageTimer::StageTimer(StageTimes& times, std::string_view stage) noexcept
    : times_(times),
      stage_(stage),
      wall_start_ns_(now_ns(CLOCK_MONOTONIC)),
      cpu_start_ns_(now_ns(CLOCK_THREAD_CPUTIME_ID)) {}

StageTimer::~StageTimer() {
  times_.add(stage_, now_ns(CLOCK_MONOTONIC) - wall_start_ns_, now_ns(CLOCK_THREAD_CPUTIME_ID) - cpu_start_ns_);
}

}  // namespace panvo::runtime
