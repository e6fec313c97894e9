// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "context_state.hpp"
#include "node_services/controlled.hpp"

namespace panvo::runtime::node_services {

/// Gives service requests access to a loaded component.
class ComponentNode final : public ControlledNode {
 public:
  /// `shut_down` schedules stopping it; `parameters_set` is called with the parameters that were set.
  ComponentNode(Context::State& state, std::function<void()> shut_down,
                std::function<void(const WrittenValues&)> parameters_set)
      : state_(state), shut_down_(std::move(shut_down)), parameters_set_(std::move(parameters_set)) {}

  std::vector<ParameterDescription> parameters() const override { return state_.parameters(); }
  std::vector<std::string> set_parameters(const WrittenValues& wanted) override {
    auto problems = state_.set_parameters(wanted);
    if (problems.empty()) parameters_set_(wanted);
    return problems;
  }
  bool is_active() const override { return state_.active; }
  /// A source cannot pause, as it would lose its position in time.
  bool set_active(bool active) override {
    if (state_.source) {
      state_.logger.warn("cannot be deactivated: it plays recorded data");
      return false;
    }
    state_.set_active(active);
    state_.logger.info("{}", active ? "activated" : "deactivated: gets no messages");
    return true;
  }
  bool shut_down() override {
    if (state_.source) {
      state_.logger.warn("cannot be shut down: it plays recorded data");
      return false;
    }
    state_.set_active(false);
    state_.finalized = true;
    state_.logger.info("shut down: stays until it is unloaded");
    shut_down_();
    return true;
  }
  bool is_shut_down() const override { return state_.finalized; }

 private:
  Context::State& state_;
  const std::function<void()> shut_down_;
  const std::function<void(const WrittenValues&)> parameters_set_;
};

}  // namespace panvo::runtime::node_services
