// SPDX-License-Identifier: Apache-2.0
// ROS 2's command-line arguments of nodes: -p and -r.
#include <functional>
#include <set>

#include "node_parameters.hpp"
#include "panvo/runtime/names.hpp"
#include "panvo/runtime/system_file.hpp"
#include "yaml.hpp"

namespace panvo::runtime {
namespace {

struct Assignment {
  std::string node;  // empty: all
  std::string name, value;
};

[[noreturn]] void refuse(const char* option, const std::string& text, const std::string& why) {
  throw ConfigError(std::string(option) + " " + text + ": " + why);
}

/// "[NODE:]NAME:=VALUE".
Assignment parse_assignment(const char* option, const std::string& text) {
  const auto assigned = text.find(":=");
  if (assigned == std::string::npos || assigned == 0) refuse(option, text, "write [NODE:]NAME:=VALUE");
  Assignment parts{"", text.substr(0, assigned), text.substr(assigned + 2)};
  if (const auto colon = parts.name.find(':'); colon != std::string::npos) {
    parts.node = parts.name.substr(0, colon);
    parts.name = parts.name.substr(colon + 1);
  }
  return parts;
}

/// Calls `change` for the wanted container and component nodes; returns their number.
template <class OfContainer, class OfComponent>
int for_nodes(SystemDescription& system, const std::string& wanted, const OfContainer& container_changes,
              const OfComponent& component_changes) {
  int count = 0;
  const auto is_wanted = [&](const auto& node) {
    return wanted.empty() || node.name == wanted || full_name(node.name_space, node.name) == wanted;
  };
  for (auto& container : system.containers) {
    std::vector<std::function<void()>> changes;  // afterwards, as they may change names
    if (is_wanted(container)) changes.emplace_back([&] { container_changes(container); });
    for (auto& component : container.components) {
      if (is_wanted(component)) changes.emplace_back([&] { component_changes(component); });
    }
    for (const auto& change : changes) change();
    count += static_cast<int>(changes.size());
  }
  return count;
}

WrittenValue value_of(const std::string& assignment, const std::string& text) {
  const Location where{"-p " + assignment, 0};
  if (!text.starts_with('[')) return {{text}, false, where};
  Findings findings;
  std::optional<WrittenValue> value;
  try {
    value = written_value(YAML::Load(text), "of the list", where, nullptr, findings);
  } catch (const YAML::Exception&) {
  }
  if (!value) refuse("-p", assignment, "write a list as [1, 2]");
  return std::move(*value);
}

void check_names(const SystemDescription& system, const std::string& rule) {
  std::set<std::string> names;
  for (const auto& container : system.containers) {
    for (const auto& component : container.components) {
      const auto name = full_name(component.name_space, component.name);
      if (!names.insert(name).second) refuse("-r", rule, "two nodes would have the name " + name);
    }
  }
}

void put_into(const std::string& name_space, bool replaces, std::string& of_node) {
  const std::string rest = of_node == "/" || replaces ? "" : of_node;
  of_node = (name_space == "/" ? "" : name_space) + rest;
  if (of_node.empty()) of_node = "/";
}

int apply_name_space(SystemDescription& system, const std::string& rule, const Assignment& parts) {
  const std::string& name_space = parts.value;
  if (const auto wrong = name_space_problem(name_space)) refuse("-r", rule, "namespace " + name_space + " " + *wrong);
  if (!name_space.starts_with('/')) refuse("-r", rule, "a namespace starts with /");
  const bool replaces = !parts.node.empty();
  const auto change = [&](auto& node) { put_into(name_space, replaces, node.name_space); };
  return for_nodes(system, parts.node, change, change);
}

int apply_name(SystemDescription& system, const std::string& rule, const Assignment& parts) {
  if (const auto wrong = node_name_problem(parts.value)) refuse("-r", rule, "name " + parts.value + " " + *wrong);
  if (!parts.node.empty()) {
    const auto change = [&](auto& node) { node.name = parts.value; };
    return for_nodes(system, parts.node, change, change);
  }
  if (system.containers.size() > 1)
    refuse("-r", rule, "the system has several containers; write CONTAINER:__node:=NAME");
  for (auto& container : system.containers) container.name = parts.value;
  return 1;
}

}  // namespace

void apply_parameter(SystemDescription& system, const std::string& assignment) {
  const Assignment parts = parse_assignment("-p", assignment);
  WrittenValue value = value_of(assignment, parts.value);
  value.is_for_several = parts.node.empty();
  const bool is_for_containers = !parts.node.empty() || NodeParameters::others({{parts.name, value}}).empty();
  const int count = for_nodes(
      system, parts.node,
      [&](ContainerDescription& container) {
        if (is_for_containers) container.parameters[parts.name] = value;
      },
      [&](ComponentDescription& component) { component.parameters[parts.name] = value; });
  if (count == 0) refuse("-p", assignment, system.file + " has no node " + parts.node);
}

void apply_remap(SystemDescription& system, const std::string& rule) {
  const Assignment parts = parse_assignment("-r", rule);
  int count = 0;
  if (parts.name == "__ns") {
    count = apply_name_space(system, rule, parts);
  } else if (parts.name == "__node" || parts.name == "__name") {
    count = apply_name(system, rule, parts);
  } else {
    for (const auto& topic : {parts.name, parts.value}) {
      if (const auto wrong = topic_name_problem(topic)) refuse("-r", rule, "topic name \"" + topic + "\" " + *wrong);
    }
    count = for_nodes(
        system, parts.node, [](const ContainerDescription&) {},
        [&](ComponentDescription& component) {
          set_remap(component.name_space, component.name, component.remaps, parts.name, parts.value);
        });
  }
  if (count == 0) refuse("-r", rule, system.file + " has no node " + parts.node);
  check_names(system, rule);
}

}  // namespace panvo::runtime
