// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iostream>
#include <map>
#include <memory>

#include "commands.hpp"
#include "config/message_from_yaml.hpp"
#include "panvo/interfaces/message_text.hpp"

namespace panvo::runtime::graph {
namespace {

bool is_server(const GraphEndpoint& endpoint) { return endpoint.kind == EndpointKind::kRequest && !endpoint.is_writer; }

void list_services(const SessionOptions& options, bool with_types) {
  Session session(options);
  std::map<std::string, std::string> services;
  for (const auto& endpoint : session.settled_graph().endpoints) {
    if (is_server(endpoint)) services[endpoint.name] = endpoint.type_name;
  }
  for (const auto& [name, type] : services) std::cout << name << (with_types ? " [" + type + "]" : "") << "\n";
}

/// Type of a service according to its server.
std::string type_of(Session& session, const std::string& name) {
  const auto is_it = [&](const GraphEndpoint& endpoint) { return is_server(endpoint) && endpoint.name == name; };
  const Graph graph = session.graph_with(
      [&](const Graph& known) { return std::any_of(known.endpoints.begin(), known.endpoints.end(), is_it); });
  const auto found = std::find_if(graph.endpoints.begin(), graph.endpoints.end(), is_it);
  if (found == graph.endpoints.end()) throw Failure("there is no service " + name + " (panvo service list)");
  return found->type_name;
}

const interfaces::MessageType& known_type(const std::string& type_name, const char* part) {
  const auto* type = interfaces::find_message_type(type_name + part);
  if (!type) {
    throw Failure("the type " + type_name + " " + interfaces::why_unknown(type_name + part));
  }
  return *type;
}

/// Whether a text is "package/srv/Name", and not YAML.
bool is_type_name(const std::string& text) {
  return text.find("/srv/") != std::string::npos && text.find_first_of("{}:, \t\n") == std::string::npos;
}

void call(const SessionOptions& options, const std::string& name, std::string type_name, const std::string& request) {
  Session session(options);
  if (type_name.empty()) type_name = type_of(session, name);
  const auto& response_type = known_type(type_name, "_Response");
  const auto bytes = message_from_yaml(known_type(type_name, "_Request"), request);
  std::cout << interfaces::to_yaml(response_type, session.call({name, type_name}, bytes), 0);
}

}  // namespace

void add_service_commands(CLI::App& app, const SessionOptions& options) {
  auto* service = app.add_subcommand("service", "services of the domain");
  service->require_subcommand(1);
  struct Arguments {
    std::string name, type, first, second;
    bool with_types = false;
  };
  const auto arguments = std::make_shared<Arguments>();
  auto* list_command = service->add_subcommand("list", "list the services");
  list_command->add_flag("-t,--show-types", arguments->with_types, "also show types");
  list_command->callback([&options, arguments] { list_services(options, arguments->with_types); });

  auto* call_command = service->add_subcommand("call", "call a service and print its response");
  call_command->add_option("SERVICE", arguments->name, "such as /binocular_odometry/get_parameters")->required();
  call_command->add_option("TYPE", arguments->first, "such as rcl_interfaces/srv/GetParameters; may be left out");
  call_command->add_option("REQUEST", arguments->second, "YAML, such as '{names: [tracking.max_features]}'");
  call_command->add_option("--type", arguments->type,
                           "such as rcl_interfaces/srv/GetParameters (default: the server's)");
  call_command->callback([&options, arguments] {
    const auto& [name, type, first, second, with_types] = *arguments;
    const bool has_type = !second.empty() || is_type_name(first);  // as in ros2 service call
    const auto& request = has_type ? second : first;
    call(options, absolute(name), has_type ? first : type, request.empty() ? "{}" : request);
  });
}

}  // namespace panvo::runtime::graph
