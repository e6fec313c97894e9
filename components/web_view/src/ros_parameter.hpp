// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "parameter.hpp"
#include "rcl_interfaces/msg/ParameterValue.h"

namespace panvo::web_view {

/// Bytes become integers, as Foxglove's protocol has no list of bytes.
ParameterValue value_of(const rcl_interfaces::msg::ParameterValue& value);

rcl_interfaces::msg::ParameterValue ros_value_of(const ParameterValue& value);

}  // namespace panvo::web_view
