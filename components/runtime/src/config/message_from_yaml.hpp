// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "panvo/interfaces/message_type.hpp"
#include "rcl_interfaces/msg/ParameterValue.h"

namespace panvo::runtime {

/// Serialises a message given as YAML, "{names: [a, b]}", as for `ros2 service call`. Missing members are zero or
/// empty. Throws ConfigError that names the member and the problem.
interfaces::Bytes message_from_yaml(const interfaces::MessageType& type, const std::string& text);

/// Parses a parameter value: true, 5, 0.5, fast, "5" (a string), [1.0, 2.0]. Throws ConfigError if it is not a ROS 2
/// parameter value.
rcl_interfaces::msg::ParameterValue parameter_value_from_yaml(const std::string& text);

}  // namespace panvo::runtime
