// SPDX-License-Identifier: Apache-2.0
// Time of the panoramic compass per panorama, one thread (paper: 100 ms [Lu2015 Table 3]). Uses panoramas of the
// recording campus_journey.
#include <benchmark/benchmark.h>

#include <string>

#include "panvo/panoramic_compass/panoramic_compass.hpp"
#include "recorded_panoramas.hpp"

namespace {

using namespace panvo::panoramic_compass;

void compass(benchmark::State& state, const std::string& method) {
  if (lack_panoramas(state)) return;
  CompassParameters parameters;
  parameters.method = method;
  PanoramicCompass compass(parameters);
  std::int64_t i = 0;
  int valid = 0;
  for (auto _ : state) {
    // Forward and backward, so that consecutive panoramas are always from neighbouring places.
    const auto count = static_cast<std::int64_t>(recorded_panoramas().size());
    const std::int64_t at = i % (2 * count) < count ? i % (2 * count) : 2 * count - 1 - i % (2 * count);
    const auto change = compass.track(++i, recorded_panoramas()[static_cast<std::size_t>(at)]);
    valid += change && change->valid ? 1 : 0;
  }
  state.counters["valid"] = benchmark::Counter(valid, benchmark::Counter::kAvgIterations);
}
BENCHMARK_CAPTURE(compass, all_round, "all_round")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(compass, two_patches, "two_patches")->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
