// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "panvo/runtime/parameters.hpp"
#include "rcl_interfaces/msg/ParameterDescriptor.h"
#include "rcl_interfaces/msg/ParameterValue.h"

namespace panvo::runtime::node_services {

/// The constants of rcl_interfaces/msg/ParameterType.
enum class ParameterType : std::uint8_t {
  kNotSet,
  kBool,
  kInteger,
  kDouble,
  kString,
  kByteArray,
  kBoolArray,
  kIntegerArray,
  kDoubleArray,
  kStringArray
};

ParameterType ros_type(const ParameterDescription& parameter);
rcl_interfaces::msg::ParameterValue ros_value(const ParameterDescription& parameter);
rcl_interfaces::msg::ParameterDescriptor ros_descriptor(const ParameterDescription& parameter);

/// Converts to the form of a system file; nullopt if not set or of an unknown type.
std::optional<WrittenValue> written_value(const rcl_interfaces::msg::ParameterValue& value);

/// Returns what is wrong with the type of a value for the parameter; nullopt if it fits. An integer is accepted as a
/// double.
std::optional<std::string> type_problem(const ParameterDescription& parameter,
                                        const rcl_interfaces::msg::ParameterValue& value);

}  // namespace panvo::runtime::node_services
