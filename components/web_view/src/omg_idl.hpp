// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace panvo::web_view {

/// Name of a type in OMG IDL: "nav_msgs::msg::Odometry" for "nav_msgs/msg/Odometry".
std::string idl_name(std::string_view type_name);

/// Definition of a type and all nested types in OMG IDL, each after those that it contains. `definition`: the same in ROS
/// 2's .msg notation, as MessageType has it. Comments and default values are left out: nothing is decoded by them.
std::string idl_definition(std::string_view type_name, std::string_view definition);

}  // namespace panvo::web_view
