// SPDX-License-Identifier: Apache-2.0
#include "sensor_notices.hpp"

namespace panvo::odometry_fusion {

void SensorNotices::report(const std::string& sensor, const SensorState& now) {
  if (now.is_used && !before_.is_used) log_.info("{}: agreement with the cameras, used from now on", sensor);
  if (!now.fault.empty() && now.fault != before_.fault) log_.warn("{}: {}; not used", sensor, now.fault);
  before_ = now;
}

}  // namespace panvo::odometry_fusion
