// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iostream>
#include <memory>
#include <set>

#include "commands.hpp"
#include "config/message_from_yaml.hpp"
#include "node_services/parameter_values.hpp"
#include "panvo/interfaces/message_text.hpp"
#include "rcl_interfaces/srv/DescribeParameters.h"
#include "rcl_interfaces/srv/GetParameters.h"
#include "rcl_interfaces/srv/ListParameters.h"
#include "rcl_interfaces/srv/SetParameters.h"

namespace panvo::runtime::graph {
namespace {

using namespace rcl_interfaces::srv;  // NOLINT(google-build-using-namespace): the requests and responses of this file
using node_services::ParameterType;

const char* type_name(std::uint8_t type) {
  constexpr const char* kNames[] = {"not set",    "boolean",       "integer",       "double",       "string",
                                    "byte array", "boolean array", "integer array", "double array", "string array"};
  return type < std::size(kNames) ? kNames[type] : "unknown";
}

/// In the notation of a system file.
std::string shown(const rcl_interfaces::msg::ParameterValue& value) {
  const auto written = node_services::written_value(value);
  if (!written) return "not set";
  return written->is_list ? to_text(written->items) : written->items.at(0);
}

std::vector<std::string> names_of(Session& session, const std::string& node, const std::vector<std::string>& prefixes) {
  ListParameters_Request request;
  request.prefixes(prefixes);
  return session.call<ListParameters_Response>(node + "/list_parameters", "rcl_interfaces/srv/ListParameters", request)
      .result()
      .names();
}

/// In the order of `names`; not set: those that are unknown or have no value.
std::vector<rcl_interfaces::msg::ParameterValue> values_of(Session& session, const std::string& node,
                                                           const std::vector<std::string>& names) {
  GetParameters_Request request;
  request.names(names);
  auto values =
      session.call<GetParameters_Response>(node + "/get_parameters", "rcl_interfaces/srv/GetParameters", request)
          .values();
  // Nodes of rclcpp and rclpy answer with nothing if one of the parameters is unknown or declared without a value.
  while (values.size() < names.size())
    values.push_back(names.size() == 1 ? rcl_interfaces::msg::ParameterValue()
                                       : values_of(session, node, {names[values.size()]}).at(0));
  return values;
}

std::set<std::string> nodes_with_parameters(Session& session) {
  constexpr std::string_view kEnd = "/list_parameters";
  std::set<std::string> nodes;
  for (const auto& endpoint : session.settled_graph().endpoints) {
    const bool is_server = endpoint.kind == EndpointKind::kRequest && !endpoint.is_writer;
    if (is_server && endpoint.name.ends_with(kEnd))
      nodes.insert(endpoint.name.substr(0, endpoint.name.size() - kEnd.size()));
  }
  return nodes;
}

struct Arguments {
  std::string node, name, value;
  std::vector<std::string> prefixes;
};

void list_parameters(const SessionOptions& options, const Arguments& arguments) {
  Session session(options);
  if (!arguments.node.empty()) {
    for (const auto& name : names_of(session, absolute(arguments.node), arguments.prefixes)) std::cout << name << "\n";
    return;
  }
  for (const auto& node : nodes_with_parameters(session)) {
    std::cout << node << ":\n";
    for (const auto& name : names_of(session, node, arguments.prefixes)) std::cout << "  " << name << "\n";
  }
}

void get(const SessionOptions& options, const Arguments& arguments) {
  Session session(options);
  const std::string node = absolute(arguments.node);
  const auto values = values_of(session, node, {arguments.name});
  if (values[0].type() == static_cast<std::uint8_t>(ParameterType::kNotSet))
    throw Failure("node " + node + " has no parameter " + arguments.name + " (panvo param list " + node + ")");
  std::cout << shown(values[0]) << "\n";
}

void set(const SessionOptions& options, const Arguments& arguments) {
  SetParameters_Request request;
  request.parameters().resize(1);
  request.parameters()[0].name(arguments.name);
  request.parameters()[0].value(parameter_value_from_yaml(arguments.value));
  Session session(options);
  const auto results = session
                           .call<SetParameters_Response>(absolute(arguments.node) + "/set_parameters",
                                                         "rcl_interfaces/srv/SetParameters", request)
                           .results();
  if (results.empty()) throw Failure("the node returned no result");
  if (!results[0].successful()) throw Failure("not set: " + results[0].reason());
  std::cout << "set\n";
}

void describe(const SessionOptions& options, const Arguments& arguments) {
  Session session(options);
  const std::string node = absolute(arguments.node);
  DescribeParameters_Request request;
  request.names(arguments.name.empty() ? names_of(session, node, {}) : std::vector<std::string>{arguments.name});
  const auto descriptors = session
                               .call<DescribeParameters_Response>(node + "/describe_parameters",
                                                                  "rcl_interfaces/srv/DescribeParameters", request)
                               .descriptors();
  const auto values = values_of(session, node, request.names());
  for (std::size_t i = 0; i < descriptors.size() && i < values.size(); ++i) {
    const auto& one = descriptors[i];
    std::cout << one.name() << " = " << shown(values[i]) << "\n  " << type_name(one.type());
    for (const auto& range : one.integer_range()) std::cout << ", " << range.from_value() << " .. " << range.to_value();
    for (const auto& range : one.floating_point_range())
      std::cout << ", " << to_text(range.from_value()) << " .. " << to_text(range.to_value());
    if (!one.additional_constraints().empty()) std::cout << ", " << one.additional_constraints();
    std::cout << (one.read_only() ? ", read-only" : ", settable") << "\n";
    if (!one.description().empty()) std::cout << "  " << one.description() << "\n";
  }
}

}  // namespace

void add_param_commands(CLI::App& app, const SessionOptions& options) {
  auto* param = app.add_subcommand("param", "parameters of nodes");
  param->require_subcommand(1);
  const auto arguments = std::make_shared<Arguments>();
  const auto add = [&](const char* name, const char* what, void (*run)(const SessionOptions&, const Arguments&)) {
    auto* command = param->add_subcommand(name, what);
    command->callback([&options, arguments, run] { run(options, *arguments); });
    return command;
  };
  auto* list_command = add("list", "list the parameters of one or all nodes", list_parameters);
  list_command->add_option("NODE", arguments->node, "such as /binocular_odometry");
  list_command->add_option("--prefix", arguments->prefixes, "only parameters below this prefix, such as tracking");
  auto* get_command = add("get", "print the value of a parameter", get);
  auto* set_command = add("set", "set a parameter, if its node allows it", set);
  for (auto* command : {get_command, set_command}) {
    command->add_option("NODE", arguments->node)->required();
    command->add_option("NAME", arguments->name)->required();
  }
  set_command->add_option("VALUE", arguments->value, "YAML: true, 5, 0.5, fast, [1.0, 2.0]")->required();
  auto* describe_command = add("describe", "describe a parameter: purpose, type and range", describe);
  describe_command->add_option("NODE", arguments->node)->required();
  describe_command->add_option("NAME", arguments->name, "(default: all)");
}

}  // namespace panvo::runtime::graph
