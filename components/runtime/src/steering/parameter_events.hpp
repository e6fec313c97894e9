// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/parameters.hpp"
#include "rcl_interfaces/msg/ParameterEvent.h"

namespace panvo::runtime::steering {

/// Where ROS 2's tools hear of the parameters of all nodes, as its own nodes offer it.
inline constexpr interfaces::Topic<rcl_interfaces::msg::ParameterEvent> kParameterEvents{"/parameter_events",
                                                                                         {.depth = 1000}};

/// That a node has come, with these parameters.
rcl_interfaces::msg::ParameterEvent new_parameters(const std::string& full_name,
                                                   const std::vector<ParameterDescription>& parameters,
                                                   std::int64_t stamp_ns);

/// That those of a node's parameters that `set` names have now the values that they have in `parameters`.
rcl_interfaces::msg::ParameterEvent changed_parameters(const std::string& full_name,
                                                       const std::vector<ParameterDescription>& parameters,
                                                       const WrittenValues& set, std::int64_t stamp_ns);

}  // namespace panvo::runtime::steering
