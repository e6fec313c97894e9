// SPDX-License-Identifier: Apache-2.0
// Parameter services of a node, compatible with rclcpp.
#include <algorithm>

#include "node_services/controlled.hpp"
#include "node_services/parameter_values.hpp"
#include "rcl_interfaces/srv/DescribeParameters.h"
#include "rcl_interfaces/srv/GetParameterTypes.h"
#include "rcl_interfaces/srv/GetParameters.h"
#include "rcl_interfaces/srv/ListParameters.h"
#include "rcl_interfaces/srv/SetParameters.h"
#include "rcl_interfaces/srv/SetParametersAtomically.h"

namespace panvo::runtime::node_services {
namespace {

using namespace rcl_interfaces::srv;  // NOLINT(google-build-using-namespace): the requests and responses of this file
using rcl_interfaces::msg::Parameter;
using rcl_interfaces::msg::SetParametersResult;

constexpr char kSeparator = '.';

const ParameterDescription* find(const std::vector<ParameterDescription>& parameters, const std::string& name) {
  const auto found = std::ranges::find(parameters, name, &ParameterDescription::name);
  return found == parameters.end() ? nullptr : &*found;
}

/// An unknown name gets a value without type, so values match the names in order.
GetParameters_Response get(const ControlledNode& node, const GetParameters_Request& request) {
  const auto parameters = node.parameters();
  GetParameters_Response response;
  for (const auto& name : request.names()) {
    const auto* parameter = find(parameters, name);
    response.values().push_back(parameter ? ros_value(*parameter) : rcl_interfaces::msg::ParameterValue());
  }
  return response;
}

GetParameterTypes_Response get_types(const ControlledNode& node, const GetParameterTypes_Request& request) {
  const auto parameters = node.parameters();
  GetParameterTypes_Response response;
  for (const auto& name : request.names()) {
    const auto* parameter = find(parameters, name);
    response.types().push_back(static_cast<std::uint8_t>(parameter ? ros_type(*parameter) : ParameterType::kNotSet));
  }
  return response;
}

DescribeParameters_Response describe(const ControlledNode& node, const DescribeParameters_Request& request) {
  const auto parameters = node.parameters();
  DescribeParameters_Response response;
  for (const auto& name : request.names()) {
    rcl_interfaces::msg::ParameterDescriptor unknown;
    unknown.name(name);
    const auto* parameter = find(parameters, name);
    response.descriptors().push_back(parameter ? ros_descriptor(*parameter) : unknown);
  }
  return response;
}

/// Whether a name, without its prefix, has at most `depth` parts; 0: any number.
bool is_within(std::string_view name, std::uint64_t depth) {
  return depth == 0 || static_cast<std::uint64_t>(std::ranges::count(name, kSeparator)) < depth;
}

bool is_listed(const std::string& name, const ListParameters_Request& request) {
  if (request.prefixes().empty()) return is_within(name, request.depth());
  return std::ranges::any_of(request.prefixes(), [&](const std::string& prefix) {
    if (name == prefix) return true;
    return name.starts_with(prefix + kSeparator) &&
           is_within(std::string_view(name).substr(prefix.size() + 1), request.depth());
  });
}

ListParameters_Response list(const ControlledNode& node, const ListParameters_Request& request) {
  ListParameters_Response response;
  auto& prefixes = response.result().prefixes();
  for (const auto& parameter : node.parameters()) {
    if (!is_listed(parameter.name, request)) continue;
    response.result().names().push_back(parameter.name);
    const auto end = parameter.name.rfind(kSeparator);
    if (end == std::string::npos) continue;
    const std::string prefix = parameter.name.substr(0, end);
    if (std::ranges::find(prefixes, prefix) == prefixes.end()) prefixes.push_back(prefix);
  }
  return response;
}

SetParametersResult set_together(ControlledNode& node, const std::vector<Parameter>& wanted) {
  const auto parameters = node.parameters();
  WrittenValues values;
  std::string problems;
  const auto add_problem = [&](const std::string& problem) { problems += (problems.empty() ? "" : "; ") + problem; };
  for (const auto& parameter : wanted) {
    auto value = written_value(parameter.value());
    const auto* known = find(parameters, parameter.name());
    if (!value) {
      add_problem(parameter.name() + " has no value: parameters cannot be removed");
    } else if (const auto problem = known ? type_problem(*known, parameter.value()) : std::nullopt) {
      add_problem(*problem);
    } else {
      values[parameter.name()] = std::move(*value);
    }
  }
  if (problems.empty()) {
    for (const auto& problem : node.set_parameters(values)) add_problem(problem);
  }
  SetParametersResult result;
  result.successful(problems.empty());
  result.reason(problems);
  return result;
}

SetParameters_Response set(ControlledNode& node, const SetParameters_Request& request) {
  SetParameters_Response response;
  for (const auto& parameter : request.parameters()) response.results().push_back(set_together(node, {parameter}));
  return response;
}

SetParametersAtomically_Response set_atomically(ControlledNode& node, const SetParametersAtomically_Request& request) {
  SetParametersAtomically_Response response;
  response.result(set_together(node, request.parameters()));
  return response;
}

SetParametersResult refused(const std::string& why) {
  SetParametersResult result;
  result.successful(false);
  result.reason(why);
  return result;
}

SetParameters_Response refuse_to_set(const SetParameters_Request& request, const std::string& why) {
  SetParameters_Response response;
  response.results().assign(request.parameters().size(), refused(why));
  return response;
}

SetParametersAtomically_Response refuse_to_set_atomically(const SetParametersAtomically_Request&,
                                                          const std::string& why) {
  SetParametersAtomically_Response response;
  response.result(refused(why));
  return response;
}

template <class Request, class Response, class Node>
OfferedService offer(const std::string& name, const char* type, Node& node, Response (*answer)(Node&, const Request&)) {
  return {
      {name, std::string("rcl_interfaces/srv/") + type},
      service_handler<Request, Response>([&node, answer](const Request& request) { return answer(node, request); })};
}

}  // namespace

std::vector<OfferedService> parameter_services(const std::string& full_name, ControlledNode& node) {
  const ControlledNode& constant = node;
  auto sets = offer(full_name + "/set_parameters", "SetParameters", node, set);
  auto sets_atomically =
      offer(full_name + "/set_parameters_atomically", "SetParametersAtomically", node, set_atomically);
  sets.refuse = refusal_of(refuse_to_set);
  sets_atomically.refuse = refusal_of(refuse_to_set_atomically);
  return {offer(full_name + "/get_parameters", "GetParameters", constant, get),
          offer(full_name + "/get_parameter_types", "GetParameterTypes", constant, get_types),
          offer(full_name + "/list_parameters", "ListParameters", constant, list),
          offer(full_name + "/describe_parameters", "DescribeParameters", constant, describe),
          std::move(sets),
          std::move(sets_atomically)};
}

}  // namespace panvo::runtime::node_services
