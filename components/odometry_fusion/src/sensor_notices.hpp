// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "panvo/odometry_fusion/odometry_fusion.hpp"
#include "panvo/runtime/logger.hpp"

namespace panvo::odometry_fusion {

/// Logs when a sensor begins to be used, and what is wrong with one that is not.
class SensorNotices {
 public:
  explicit SensorNotices(const runtime::Logger& log) : log_(log) {}

  void report(const std::string& sensor, const SensorState& now);

 private:
  const runtime::Logger& log_;
  SensorState before_;
};

}  // namespace panvo::odometry_fusion
