// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "context_state.hpp"
#include "library.hpp"
#include "node_services/component_node.hpp"
#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/names.hpp"
#include "restart_plan.hpp"

namespace panvo::runtime {

/// Everything needed to create and restart a component.
struct Recipe {
  using Create = std::function<std::unique_ptr<Component, void (*)(Component*)>(Context&)>;

  ComponentDescription description;
  std::shared_ptr<Library> library;
  Create create;
  bool by_request = false;  // loaded by service request: restricted in the files it may name
  std::uint64_t id = 0;     // never reused
  RestartPlan restarts{};
  std::optional<std::int64_t> restart_ns{};  // time of the restart after a failure
  bool given_up = false;
  std::uint64_t restarted = 0;  // number of restarts
};

/// A loaded component. Members are destroyed in an order that keeps all code mapped that may still run: the component,
/// its callbacks in the runtime, then the plugin.
struct LoadedComponent {
  Recipe recipe;
  std::unique_ptr<Context> context;
  std::unique_ptr<Component, void (*)(Component*)> component{nullptr, nullptr};
  std::shared_ptr<UntypedOutput> transition_events;  // nullptr without services
  std::unique_ptr<node_services::ComponentNode> node;
  std::vector<std::unique_ptr<BridgeService>> services;  // use `node`

  ~LoadedComponent() {
    services.clear();
    if (context) context->state().host.withdraw(node.get());
    if (context) context->state().stop();
  }

  std::string full_name() const {
    const auto& description = context->state().description;
    return runtime::full_name(description.name_space, description.name);
  }
};

}  // namespace panvo::runtime
