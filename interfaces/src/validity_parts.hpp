// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "geometry_msgs/msg/Pose.h"
#include "geometry_msgs/msg/PoseWithCovariance.h"
#include "geometry_msgs/msg/Twist.h"
#include "panvo/interfaces/check.hpp"
#include "std_msgs/msg/Header.h"

/// Rules of members that several messages have.
namespace panvo::interfaces {

inline void check_stamp(Check& check, MemberName name, const builtin_interfaces::msg::Time& stamp) {
  check.require(stamp.nanosec() < 1'000'000'000, name, "has a nanosec of 1e+09 or more");
}

inline void check_header(Check& check, const std_msgs::msg::Header& header) {
  check_stamp(check, {"header", "stamp"}, header.stamp());
  check.name({"header", "frame_id"}, header.frame_id());
}

inline void check_rotation(Check& check, MemberName name, const geometry_msgs::msg::Quaternion& rotation) {
  check.quaternion(name, rotation.x(), rotation.y(), rotation.z(), rotation.w());
}

inline void check_pose(Check& check, std::string_view name, const geometry_msgs::msg::Pose& pose) {
  const auto& position = pose.position();
  check.bounded({name, "position"}, {position.x(), position.y(), position.z()}, kMaxCoordinate_m);
  check_rotation(check, {name, "orientation"}, pose.orientation());
}

inline void check_twist(Check& check, std::string_view name, const geometry_msgs::msg::Twist& twist) {
  const auto& linear = twist.linear();
  const auto& angular = twist.angular();
  check.bounded({name, "linear"}, {linear.x(), linear.y(), linear.z()}, kMaxRate);
  check.bounded({name, "angular"}, {angular.x(), angular.y(), angular.z()}, kMaxRate);
}

}  // namespace panvo::interfaces
