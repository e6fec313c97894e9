// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "panvo/evaluation/journey_run.hpp"

namespace panvo::evaluation {

/// Time of a drive since its first pose.
class DriveClock {
 public:
  explicit DriveClock(const JourneyRun& run)
      : start_ns_(std::min(run.enhanced.poses.front().stamp_ns, run.binocular.poses.front().stamp_ns)) {}

  double seconds(std::int64_t stamp_ns) const { return 1e-9 * static_cast<double>(stamp_ns - start_ns_); }

 private:
  std::int64_t start_ns_;
};

}  // namespace panvo::evaluation
