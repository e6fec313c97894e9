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
#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/names.hpp"
#include "restart_plan.hpp"
#include "steering/component_node.hpp"

namespace panvo::runtime {

/// What it takes to make a component, and to make it anew.
struct Recipe {
  using Create = std::function<std::unique_ptr<Component, void (*)(Component*)>(Context&)>;

  ComponentDescription description;
  std::shared_ptr<Library> library;
  Create create;
  bool by_request = false;  // another process asked for it: it may name no files but those that are allowed
  std::uint64_t id = 0;     // never used again
  RestartPlan restarts{};
  std::optional<std::int64_t> restart_ns{};  // when it is to be made anew, since it has failed
  bool given_up = false;
  std::uint64_t restarted = 0;  // how often
};

/// A loaded component. Its members go in the order that keeps all code mapped that may still run: first the component, then what the
/// runtime holds of it (callbacks are the plugin's code), then the plugin.
struct LoadedComponent {
  Recipe recipe;
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
