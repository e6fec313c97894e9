// SPDX-License-Identifier: Apache-2.0
// Services to load, unload and list components, compatible with rclcpp_components.
#include <spdlog/fmt/fmt.h>

#include "composition_interfaces/srv/ListNodes.h"
#include "composition_interfaces/srv/LoadNode.h"
#include "composition_interfaces/srv/UnloadNode.h"
#include "node_services/controlled.hpp"
#include "node_services/parameter_values.hpp"
#include "panvo/runtime/errors.hpp"
#include "panvo/runtime/names.hpp"

namespace panvo::runtime::node_services {
namespace {

using namespace composition_interfaces::srv;  // NOLINT(google-build-using-namespace): as in parameter_services.cpp

constexpr const char* kLoadNode = "load_node";

std::string default_name(const std::string& package) {
  constexpr std::string_view kOurs = "panvo_";
  return package.starts_with(kOurs) ? package.substr(kOurs.size()) : package;
}

/// The name and namespace of the node that is asked for. A rule `__node:=NAME` or `__ns:=/NS` wins, as in rclcpp.
struct RequestedName {
  std::string name, name_space;
};

/// Takes the rules for the node's name out of `rules`.
RequestedName take_name(const LoadNode_Request& request, std::vector<std::string>& rules) {
  RequestedName node{request.node_name().empty() ? default_name(request.package_name()) : request.node_name(),
                     request.node_namespace()};
  std::erase_if(rules, [&](const std::string& rule) {
    const auto separator = rule.find(":=");
    const auto subject = rule.substr(0, separator);
    const bool is_name = subject == "__node" || subject == "__name";
    if (separator == std::string::npos || (!is_name && subject != "__ns")) return false;
    (is_name ? node.name : node.name_space) = rule.substr(separator + 2);
    return true;
  });
  return node;
}

/// Converts a request to a component description; adds problems to `problems`.
ComponentDescription requested_component(const LoadNode_Request& request, std::vector<std::string>& problems) {
  ComponentDescription description;
  description.package = request.package_name();
  description.plugin = request.plugin_name();
  auto rules = request.remap_rules();
  const auto node = take_name(request, rules);
  description.name = node.name;
  description.where = {kLoadNode, 0};
  const auto complain = [&](const std::string& what) { problems.push_back(std::string(kLoadNode) + ": " + what); };
  if (const auto wrong = package_name_problem(description.package))
    complain("package \"" + description.package + "\" " + *wrong);
  if (const auto wrong = class_name_problem(description.plugin))
    complain("plugin \"" + description.plugin + "\" " + *wrong);
  if (const auto wrong = node_name_problem(description.name))
    complain("node name \"" + description.name + "\" " + *wrong);
  if (const auto wrong = name_space_problem(node.name_space)) {
    complain("namespace \"" + node.name_space + "\" " + *wrong);
  } else {
    description.name_space = join_name_spaces("/", node.name_space);
  }
  for (const auto& rule : rules) {
    const auto separator = rule.find(":=");
    const std::string from = rule.substr(0, separator),
                      to = separator == std::string::npos ? "" : rule.substr(separator + 2);
    if (topic_name_problem(from) || topic_name_problem(to)) {
      complain("remap rule \"" + rule + "\" is invalid; write from:=to with two topic names");
    } else {
      set_remap(description.name_space, description.name, description.remaps, from, to);
    }
  }
  for (const auto& parameter : request.parameters()) {
    auto value = written_value(parameter.value());
    if (!value) {
      complain("parameter " + parameter.name() + " has no value");
      continue;
    }
    value->where = description.where;
    description.parameters[parameter.name()] = std::move(*value);
  }
  return description;
}

LoadNode_Response load_node(ControlledContainer& container, const LoadNode_Request& request) {
  LoadNode_Response response;
  std::vector<std::string> problems;
  const auto description = requested_component(request, problems);
  try {
    if (!problems.empty()) throw ConfigError(problems);
    const auto loaded = container.load_component(description);
    response.success(true);
    response.full_node_name(loaded.full_name);
    response.unique_id(loaded.id);
  } catch (const ConfigError& error) {
    response.error_message(fmt::format("{}", fmt::join(error.problems(), "; ")));
  }
  return response;
}

UnloadNode_Response unload_node(ControlledContainer& container, const UnloadNode_Request& request) {
  UnloadNode_Response response;
  try {
    container.unload_component(request.unique_id());
    response.success(true);
  } catch (const ConfigError& error) {
    response.error_message(fmt::format("{}", fmt::join(error.problems(), "; ")));
  }
  return response;
}

ListNodes_Response list_nodes(ControlledContainer& container, const ListNodes_Request&) {
  ListNodes_Response response;
  for (const auto& [id, full_name] : container.loaded_components()) {
    response.unique_ids().push_back(id);
    response.full_node_names().push_back(full_name);
  }
  return response;
}

template <class Request, class Response>
Response refuse_load(const Request&, const std::string& why) {
  Response response;
  response.error_message(why);
  return response;
}

template <class Request, class Response>
OfferedService offer_loading(const std::string& name, const char* type, ControlledContainer& container,
                             Response (*answer)(ControlledContainer&, const Request&)) {
  return {{name, std::string("composition_interfaces/srv/") + type},
          service_handler<Request, Response>(
              [&container, answer](const Request& request) { return answer(container, request); })};
}

}  // namespace

std::vector<OfferedService> component_services(const std::string& full_name, ControlledContainer& container) {
  const std::string prefix = full_name + "/_container/";
  auto loads = offer_loading(prefix + "load_node", "LoadNode", container, load_node);
  auto unloads = offer_loading(prefix + "unload_node", "UnloadNode", container, unload_node);
  loads.refuse = refusal_of(refuse_load<LoadNode_Request, LoadNode_Response>);
  unloads.refuse = refusal_of(refuse_load<UnloadNode_Request, UnloadNode_Response>);
  return {std::move(loads), std::move(unloads),
          offer_loading(prefix + "list_nodes", "ListNodes", container, list_nodes)};
}

}  // namespace panvo::runtime::node_services
