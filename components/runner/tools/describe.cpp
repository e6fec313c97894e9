// SPDX-License-Identifier: Apache-2.0
#include "describe.hpp"

#include <iostream>

#include "container_name.hpp"
#include "panvo/runtime/container.hpp"
#include "panvo/runtime/names.hpp"

namespace panvo::runner {
namespace {

void say_nothing(runtime::LogLevel, const std::string&, const std::string&) {}

void describe_container(const runtime::ContainerDescription& description, bool is_part_of_system) {
  runtime::Container container({.replay = true, .log = say_nothing, .is_part_of_system = is_part_of_system});
  container.load_all(description.components);
  const auto links = container.links();
  std::cout << "container " << description.name << "\n";
  for (const auto& topic : links.published) std::cout << "publishes " << topic << "\n";
  for (const auto& topic : links.subscribed) std::cout << "subscribes " << topic << "\n";
  if (links.reads_all) std::cout << "reads_all\n";
  if (links.has_source) std::cout << "has_source\n";
  std::cout << "node " << runtime::full_name(description.name_space, node_name(description)) << "\n";
  for (const auto& component : description.components)
    std::cout << "node " << runtime::full_name(component.name_space, component.name) << "\n";
  if (description.services == runtime::ServiceAccess::kOff) std::cout << "services off\n";
}

}  // namespace

void describe(const runtime::SystemDescription& system) {
  for (const auto& container : system.containers) describe_container(container, system.containers.size() > 1);
}

}  // namespace panvo::runner
