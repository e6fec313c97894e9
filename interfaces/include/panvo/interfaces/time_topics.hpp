// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/interfaces/topics.hpp"
#include "sensor_msgs/msg/TimeReference.h"

/// Clocks of the sensors. Apart from the other topics, as the message is in the library panvo::sensor_msgs.
namespace panvo::topics {

/// A time of the odometry's clock and the same moment by the panoramic camera's, whose offset is taken as constant.
inline constexpr Topic<sensor_msgs::msg::TimeReference> kPanoramaTimeReference{
    "panorama/time_reference", {.durability = interfaces::Durability::kTransientLocal, .depth = 1}};

}  // namespace panvo::topics
