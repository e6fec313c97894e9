// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "panvo/interfaces/topic.hpp"
#include "panvo/runtime/parameters.hpp"
#include "rcl_interfaces/msg/ParameterEvent.h"

namespace panvo::runtime::node_services {

/// ROS 2's topic for parameter changes of all nodes.
inline constexpr interfaces::Topic<rcl_interfaces::msg::ParameterEvent> kParameterEvents{"/parameter_events",
                                                                                         {.depth = 1000}};

/// Event for a new node with these parameters.
rcl_interfaces::msg::ParameterEvent new_parameters(const std::string& full_name,
                                                   const std::vector<ParameterDescription>& parameters,
                                                   std::int64_t stamp_ns);

/// Event for the parameters named in `set`, with their new values in `parameters`.
rcl_interfaces::msg::ParameterEvent changed_parameters(const std::string& full_name,
                                                       const std::vector<ParameterDescription>& parameters,
                                                       const WrittenValues& set, std::int64_t stamp_ns);

}  // namespace panvo::runtime::node_services
