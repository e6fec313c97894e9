// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "nav_msgs/msg/Odometry.h"

namespace panvo::runner {

/// Stamp in s with nine decimals: "1317046452.003070000". Integer arithmetic, as a double cannot hold the nanoseconds.
std::string stamp_text(std::int64_t stamp_ns);

/// `t x y z qx qy qz qw`; nullopt if a number is not finite.
std::optional<std::string> tum_line(const nav_msgs::msg::Odometry& odometry);

/// "stamp_ns,p00,p01,..p55,t00,..t55,vx,vy,vz,wx,wy,wz"
std::string covariance_header();

/// Both covariances, row-major, and the twist; nullopt if a number is not finite.
std::optional<std::string> covariance_line(const nav_msgs::msg::Odometry& odometry);

}  // namespace panvo::runner
