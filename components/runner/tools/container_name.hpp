// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "panvo/runtime/names.hpp"
#include "panvo/runtime/system_file.hpp"

namespace panvo::runner {

/// Node name of a container, which must differ from its components' names.
inline std::string node_name(const runtime::ContainerDescription& container) {
  for (const auto& component : container.components) {
    if (runtime::full_name(component.name_space, component.name) ==
        runtime::full_name(container.name_space, container.name))
      return container.name + "_container";
  }
  return container.name;
}

}  // namespace panvo::runner
