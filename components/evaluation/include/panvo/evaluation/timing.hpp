// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace panvo::evaluation {

// Milliseconds.
struct TimeSummary {
  double mean_ms = 0.0;
  double median_ms = 0.0;
  double p95_ms = 0.0;
  double p99_ms = 0.0;
  double max_ms = 0.0;
};

struct StageTime {
  std::string component;
  std::string stage;
  std::int64_t count = 0;
  TimeSummary wall;
  TimeSummary cpu;
};

using StageTimes = std::vector<StageTime>;  // in the order of the file

// timing.json of a run: {"components": {NAME: {"stages": {STAGE: {"count", "wall_ms": {"mean", "median", "p95", "p99",
// "max"}, "cpu_ms": {the same}}}}}}. Throws InputError naming a missing key or a key of wrong type.
StageTimes read_timing(const std::filesystem::path& file);

}  // namespace panvo::evaluation
