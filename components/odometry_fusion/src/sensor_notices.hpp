// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "panvo/odometry_fusion/odometry_fusion.hpp"
#include "panvo/runtime/logger.hpp"

namespace panvo::odometry_fusion {

/// Logs when a sensor begins or ceases to be used, and what is wrong with it.
class SensorNotices {
 public:
  explicit SensorNotices(const runtime::Logger& log) : log_(log) {}

  void report(const std::string& topic, const SensorState& now) {
    if (now.is_used && !before_.is_used) log_.info("{} agrees with the cameras and is used", topic);
    if (!now.fault.empty() && now.fault != before_.fault) log_.warn("{}: {}; not used", topic, now.fault);
    before_ = now;
  }

 private:
  const runtime::Logger& log_;
  SensorState before_;
};

}  // namespace panvo::odometry_fusion
