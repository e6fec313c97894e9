// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/stage_times.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <thread>
#include <vector>

namespace panvo::runtime {
namespace {

double nearest_rank_ms(std::vector<std::int64_t> sorted_ns, double fraction) {
  const auto rank = static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(sorted_ns.size())));
  return static_cast<double>(sorted_ns[std::max<std::size_t>(rank, 1) - 1]) * 1e-6;
}

TEST(DurationHistogram, QuantilesAreWithinTwoPercentOfSortedData) {
  std::mt19937_64 random(7);
  // Durations spread evenly over the decades from 1 us to 400 s, and typical stage times: about 16 ms with a long tail.
  for (const bool all_decades : {true, false}) {
    std::uniform_real_distribution<double> decade(3.0, 11.6);
    std::lognormal_distribution<double> stage(std::log(16e6), 0.4);
    DurationHistogram histogram;
    std::vector<std::int64_t> durations_ns;
    for (int i = 0; i < 20000; ++i) {
      durations_ns.push_back(std::llround(all_decades ? std::pow(10.0, decade(random)) : stage(random)));
      histogram.add(durations_ns.back());
    }
    std::sort(durations_ns.begin(), durations_ns.end());
    for (const double fraction : {0.0, 0.001, 0.25, 0.5, 0.95, 0.99, 0.9999, 1.0}) {
      const double expected_ms = nearest_rank_ms(durations_ns, fraction);
      EXPECT_NEAR(histogram.quantile_ms(fraction), expected_ms, 0.02 * expected_ms) << fraction;
    }
  }
}

TEST(DurationHistogram, MeanCountAndMaximumAreExact) {
  DurationHistogram histogram;
  for (const std::int64_t duration_ns : {1'000'000, 2'000'000, 6'000'000}) {
    histogram.add(duration_ns);
  }
  EXPECT_EQ(histogram.count(), 3U);
  EXPECT_DOUBLE_EQ(histogram.mean_ms(), 3.0);
  EXPECT_DOUBLE_EQ(histogram.max_ms(), 6.0);
  EXPECT_DOUBLE_EQ(histogram.quantile_ms(1.0), 6.0);
}

TEST(DurationHistogram, IsZeroWhenEmpty) {
  const DurationHistogram histogram;
  EXPECT_EQ(histogram.count(), 0U);
  EXPECT_EQ(histogram.mean_ms(), 0.0);
  EXPECT_EQ(histogram.quantile_ms(0.5), 0.0);
  EXPECT_EQ(histogram.max_ms(), 0.0);
}

TEST(DurationHistogram, TakesDurationsBeyondItsRange) {
  DurationHistogram histogram;
  histogram.add(-5);
  histogram.add(0);
  histogram.add(1);
  histogram.add(std::int64_t{1} << 60);
  EXPECT_EQ(histogram.count(), 4U);
  EXPECT_LE(histogram.quantile_ms(0.5), 1e-3);
  EXPECT_DOUBLE_EQ(histogram.quantile_ms(1.0), static_cast<double>(std::int64_t{1} << 60) * 1e-6);
}

TEST(StageTimes, KeepsStagesApartAndTakesThemFromSeveralThreads) {
  StageTimes times;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&times] {
      for (int k = 0; k < 1000; ++k) {
        times.add("track", 2'000'000, 1'000'000);
        times.add("refine", 4'000'000, 4'000'000);
      }
    });
  }
  for (auto& thread : threads) {
    thread.join();
  }
  const auto stages = times.snapshot();
  ASSERT_EQ(stages.size(), 2U);
  EXPECT_EQ(stages.at("track").wall.count(), 4000U);
  EXPECT_DOUBLE_EQ(stages.at("track").wall.mean_ms(), 2.0);
  EXPECT_DOUBLE_EQ(stages.at("track").cpu.mean_ms(), 1.0);
  EXPECT_DOUBLE_EQ(stages.at("refine").cpu.mean_ms(), 4.0);
}

TEST(StageTimer, AddsTheTimeOfItsLifeOnBothClocks) {
  StageTimes times;
  double sum = 0;
  {
    const StageTimer timer(times, "work");
    for (int i = 1; i < 2'000'000; ++i) {
      sum += 1.0 / i;
    }
  }
  EXPECT_GT(sum, 0);
  const auto stage = times.snapshot().at("work");
  EXPECT_EQ(stage.wall.count(), 1U);
  EXPECT_GT(stage.cpu.max_ms(), 0.0);
  // This thread cannot have used more CPU time than wall time; 1 ms tolerance for the clock resolutions.
  EXPECT_LE(stage.cpu.max_ms(), stage.wall.max_ms() + 1.0);
}

}  // namespace
}  // namespace panvo::runtime
