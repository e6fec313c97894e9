// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/interfaces/topics.hpp"
#include "sensor_msgs/msg/NavSatFix.h"

/// Positions by satellites. Apart from the other topics, as the message is in the library panvo::sensor_msgs.
namespace panvo::topics {

inline constexpr Topic<sensor_msgs::msg::NavSatFix> kGnssFix{"gnss/fix", kMotionSensor};
/// Where the vehicle is by all sensors.
inline constexpr Topic<sensor_msgs::msg::NavSatFix> kGnssEnhanced{"gnss/enhanced", qos::kResult};

}  // namespace panvo::topics
