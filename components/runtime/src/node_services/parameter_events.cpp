// SPDX-License-Identifier: Apache-2.0
#include "node_services/parameter_events.hpp"

#include "node_services/parameter_values.hpp"

namespace panvo::runtime::node_services {

using rcl_interfaces::msg::Parameter;
using rcl_interfaces::msg::ParameterEvent;

namespace {

ParameterEvent event_of(const std::string& full_name, std::int64_t stamp_ns) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  ParameterEvent event;
  event.stamp().sec(static_cast<std::int32_t>(stamp_ns / kSecond));
  event.stamp().nanosec(static_cast<std::uint32_t>(stamp_ns % kSecond));
  event.node(full_name);
  return event;
}

Parameter ros_parameter(const ParameterDescription& description) {
  Parameter parameter;
  parameter.name(description.name);
  parameter.value(ros_value(description));
  return parameter;
}

}  // namespace

ParameterEvent new_parameters(const std::string& full_name, const std::vector<ParameterDescription>& parameters,
                              std::int64_t stamp_ns) {
  ParameterEvent event = event_of(full_name, stamp_ns);
  for (const auto& parameter : parameters) event.new_parameters().push_back(ros_parameter(parameter));
  return event;
}

ParameterEvent changed_parameters(const std::string& full_name, const std::vector<ParameterDescription>& parameters,
                                  const WrittenValues& set, std::int64_t stamp_ns) {
  ParameterEvent event = event_of(full_name, stamp_ns);
  for (const auto& parameter : parameters) {
    if (set.contains(parameter.name)) event.changed_parameters().push_back(ros_parameter(parameter));
  }
  return event;
}

}  // namespace panvo::runtime::node_services
