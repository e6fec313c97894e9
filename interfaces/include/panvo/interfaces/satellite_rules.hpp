// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "sensor_msgs/msg/NavSatFix.h"

namespace sensor_msgs::msg {

/// With a fix: finite latitude and longitude within their ranges, and a valid covariance unless its type is unknown. The
/// altitude may be NaN.
std::optional<std::string> problem_of(const NavSatFix& message);

}  // namespace sensor_msgs::msg
