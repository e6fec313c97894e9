// SPDX-License-Identifier: Apache-2.0
#include "describe.hpp"

#include <iostream>

#include "container_name.hpp"
#include "panvo/runtime/container.hpp"
#include "panvo/runtime/names.hpp"

namespace panvo::runtime {
namespace {

void say_nothing(LogLevel, const std::string&, const std::string&) {}

void describe(const ContainerDescription& description) {
  Container container({.replay = true, .log = say_nothing});
  container.load_all(description.components);
  const auto links = container.links();
  std::cout << "container " << description.name << "\n";
  for (const auto& topic : links.published) std::cout << "publishes " << topic << "\n";
  for (const auto& topic : links.subscribed) std::cout << "subscribes " << topic << "\n";
  if (links.reads_all) std::cout << "reads_all\n";
  if (links.has_source) std::cout << "has_source\n";
  std::cout << "node " << full_name(description.name_space, node_name(description)) << "\n";
  for (const auto& component : description.components)
    std::cout << "node " << full_name(component.name_space, component.name) << "\n";
  if (description.services == ServiceAccess::kOff) std::cout << "services off\n";
}

}  // namespace

void describe(const SystemDescription& system) {
  for (const auto& container : system.containers) describe(container);
}

}  // namespace panvo::runtime
