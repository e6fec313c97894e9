// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "context_state.hpp"
#include "library.hpp"
#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/names.hpp"
#include "steering/component_node.hpp"

namespace panvo::runtime {

/// A loaded component. Its members go in the order that keeps all code mapped that may still run: first the component, then what the
/// runtime holds of it (callbacks are the plugin's code), then the plugin.
struct LoadedComponent {
  std::uint64_t id = 0;
  std::shared_ptr<Library> library;
  std::unique_ptr<Context> context;
  std::unique_ptr<Component, void (*)(Component*)> component{nullptr, nullptr};
  std::unique_ptr<steering::ComponentNode> node;
  std::vector<std::unique_ptr<BridgeService>> services;  // answer from the node

  ~LoadedComponent() {
    services.clear();
    if (context) context->state().stop();
  }

  std::string full_name() const {
    const auto& description = context->state().description;
    return runtime::full_name(description.name_space, description.name);
  }
};

}  // namespace panvo::runtime
