// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>
#include <set>

#include "commands.hpp"
#include "composition_interfaces/srv/ListNodes.h"
#include "composition_interfaces/srv/LoadNode.h"
#include "composition_interfaces/srv/UnloadNode.h"
#include "config/message_from_yaml.hpp"

namespace panvo::runtime::graph {
namespace {

using namespace composition_interfaces::srv;  // NOLINT(google-build-using-namespace): as in param_commands.cpp

constexpr std::string_view kListNodes = "/_container/list_nodes";

void running(const SessionOptions& options) {
  Session session(options);
  std::set<std::string> containers;
  for (const auto& endpoint : session.settled_graph().endpoints) {
    const bool is_server = endpoint.kind == EndpointKind::kRequest && !endpoint.is_writer;
    if (is_server && endpoint.name.ends_with(kListNodes))
      containers.insert(endpoint.name.substr(0, endpoint.name.size() - kListNodes.size()));
  }
  for (const auto& container : containers) {
    const auto nodes = session.call<ListNodes_Response>(container + std::string(kListNodes),
                                                        "composition_interfaces/srv/ListNodes", ListNodes_Request());
    std::cout << container << "\n";
    for (std::size_t i = 0; i < nodes.unique_ids().size() && i < nodes.full_node_names().size(); ++i)
      std::cout << "  " << nodes.unique_ids()[i] << "  " << nodes.full_node_names()[i] << "\n";
  }
}

struct ComponentArguments {
  std::string container, package, plugin, name, name_space;
  std::vector<std::string> parameters, remaps;
  std::vector<std::uint64_t> ids;
};

LoadNode_Request load_request(const ComponentArguments& arguments) {
  LoadNode_Request request;
  request.package_name(arguments.package);
  request.plugin_name(arguments.plugin);
  request.node_name(arguments.name);
  request.node_namespace(arguments.name_space);
  request.remap_rules(arguments.remaps);
  for (const auto& written : arguments.parameters) {
    const auto separator = written.find(":=");
    if (separator == std::string::npos) throw CLI::ValidationError("-p", written + ": write name:=value");
    rcl_interfaces::msg::Parameter parameter;
    parameter.name(written.substr(0, separator));
    parameter.value(parameter_value_from_yaml(written.substr(separator + 2)));
    request.parameters().push_back(parameter);
  }
  return request;
}

void load(const SessionOptions& options, const ComponentArguments& arguments) {
  const auto request = load_request(arguments);
  Session session(options);
  const auto response = session.call<LoadNode_Response>(absolute(arguments.container) + "/_container/load_node",
                                                        "composition_interfaces/srv/LoadNode", request);
  if (!response.success()) throw Failure("not loaded: " + response.error_message());
  std::cout << response.unique_id() << "  " << response.full_node_name() << "\n";
}

void unload(const SessionOptions& options, const ComponentArguments& arguments) {
  Session session(options);
  for (const auto id : arguments.ids) {
    UnloadNode_Request request;
    request.unique_id(id);
    const auto response = session.call<UnloadNode_Response>(absolute(arguments.container) + "/_container/unload_node",
                                                            "composition_interfaces/srv/UnloadNode", request);
    if (!response.success()) throw Failure("not unloaded: " + response.error_message());
    std::cout << "unloaded " << id << "\n";
  }
}

}  // namespace

void add_component_commands(CLI::App& app, const SessionOptions& options) {
  auto* component = app.add_subcommand("component", "components of running containers");
  component->require_subcommand(1);
  const auto arguments = std::make_shared<ComponentArguments>();
  component->add_subcommand("running", "list containers with their components and ids")->callback([&options] {
    running(options);
  });

  auto* load_command = component->add_subcommand("load", "load a component into a running container");
  load_command->add_option("CONTAINER", arguments->container, "such as /panvo")->required();
  load_command->add_option("PACKAGE", arguments->package, "such as panvo_stereo_rectifier")->required();
  load_command->add_option("PLUGIN", arguments->plugin, "such as StereoRectifierComponent")->required();
  load_command->add_option("-n,--node-name", arguments->name, "(default: the package's)");
  load_command->add_option("--node-namespace", arguments->name_space, "such as /robot");
  load_command->add_option("-p,--parameter", arguments->parameters, "name:=value, YAML; may be repeated")
      ->expected(1)
      ->take_all();
  load_command->add_option("-r,--remap-rule", arguments->remaps, "from:=to; may be repeated")->expected(1)->take_all();
  load_command->callback([&options, arguments] { load(options, *arguments); });

  auto* unload_command = component->add_subcommand("unload", "unload components of a running container");
  unload_command->add_option("CONTAINER", arguments->container)->required();
  unload_command->add_option("ID", arguments->ids, "see `panvo component running`")->required();
  unload_command->callback([&options, arguments] { unload(options, *arguments); });
}

}  // namespace panvo::runtime::graph
