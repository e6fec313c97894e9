// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "panvo/interfaces/message_type.hpp"
#include "rcl_interfaces/msg/ParameterValue.h"

namespace panvo::runtime {

/// A serialised message from what people write: "{names: [a, b]}", as `ros2 service call` takes it. What is not written is zero or empty.
/// Throws ConfigError that names the member and what is wrong.
interfaces::Bytes message_from_yaml(const interfaces::MessageType& type, const std::string& text);

/// A parameter's value from what people write: true, 5, 0.5, fast, "5" (a text), [1.0, 2.0]. Throws ConfigError for what is no value of ROS 2's.
rcl_interfaces::msg::ParameterValue parameter_value_from_yaml(const std::string& text);

}  // namespace panvo::runtime
