// SPDX-License-Identifier: Apache-2.0
// Component states in the terms of ROS 2's managed nodes: a component starts configured and active; inactive, it gets
// no messages; shut down, it stops for good, until it is unloaded. Configuring again and cleaning up do not apply.
#include <algorithm>
#include <array>
#include <string_view>

#include "clocks.hpp"
#include "lifecycle_msgs/srv/ChangeState.h"
#include "lifecycle_msgs/srv/GetAvailableStates.h"
#include "lifecycle_msgs/srv/GetAvailableTransitions.h"
#include "lifecycle_msgs/srv/GetState.h"
#include "node_services/controlled.hpp"

namespace panvo::runtime::node_services {
namespace {

using namespace lifecycle_msgs::srv;  // NOLINT(google-build-using-namespace): as in parameter_services.cpp
using lifecycle_msgs::msg::TransitionEvent;

// The constants of lifecycle_msgs/msg/State, and the labels of rcl_lifecycle. The last three are passed through within
// a request.
enum class State : std::uint8_t {
  kInactive = 2,
  kActive = 3,
  kFinalized = 4,
  kShuttingDown = 12,
  kActivating = 13,
  kDeactivating = 14
};
constexpr std::array<std::pair<State, const char*>, 6> kStates{{{State::kInactive, "inactive"},
                                                                {State::kActive, "active"},
                                                                {State::kFinalized, "finalized"},
                                                                {State::kShuttingDown, "shuttingdown"},
                                                                {State::kActivating, "activating"},
                                                                {State::kDeactivating, "deactivating"}}};

/// A transition, with the constant of lifecycle_msgs/msg/Transition.
struct Transition {
  std::uint8_t id;
  const char* label;
  State from, to;
};
constexpr const char* kDone = "transition_success";
constexpr std::array<Transition, 7> kTransitions{{{3, "activate", State::kInactive, State::kActivating},
                                                  {30, kDone, State::kActivating, State::kActive},
                                                  {4, "deactivate", State::kActive, State::kDeactivating},
                                                  {40, kDone, State::kDeactivating, State::kInactive},
                                                  {6, "shutdown", State::kInactive, State::kShuttingDown},
                                                  {7, "shutdown", State::kActive, State::kShuttingDown},
                                                  {50, kDone, State::kShuttingDown, State::kFinalized}}};

lifecycle_msgs::msg::State message_of(State state) {
  lifecycle_msgs::msg::State message;
  message.id(static_cast<std::uint8_t>(state));
  message.label(std::ranges::find(kStates, state, &std::pair<State, const char*>::first)->second);
  return message;
}

State state_of(const ControlledNode& node) {
  if (node.is_shut_down()) return State::kFinalized;
  return node.is_active() ? State::kActive : State::kInactive;
}

GetState_Response get_state(ControlledNode& node, const GetState_Request&) {
  GetState_Response response;
  response.current_state(message_of(state_of(node)));
  return response;
}

GetAvailableStates_Response get_states(ControlledNode&, const GetAvailableStates_Request&) {
  GetAvailableStates_Response response;
  for (const auto& [state, label] : kStates) response.available_states().push_back(message_of(state));
  return response;
}

template <class Wanted>
GetAvailableTransitions_Response described_transitions(const Wanted& is_wanted) {
  GetAvailableTransitions_Response response;
  for (const auto& transition : kTransitions) {
    if (!is_wanted(transition)) continue;
    lifecycle_msgs::msg::TransitionDescription description;
    description.transition().id(transition.id);
    description.transition().label(transition.label);
    description.start_state(message_of(transition.from));
    description.goal_state(message_of(transition.to));
    response.available_transitions().push_back(description);
  }
  return response;
}

GetAvailableTransitions_Response get_transitions(ControlledNode& node, const GetAvailableTransitions_Request&) {
  return described_transitions([&](const Transition& transition) { return transition.from == state_of(node); });
}

GetAvailableTransitions_Response get_graph(ControlledNode&, const GetAvailableTransitions_Request&) {
  return described_transitions([](const Transition&) { return true; });
}

bool carry_out(ControlledNode& node, State passing) {
  return passing == State::kShuttingDown ? node.shut_down() : node.set_active(passing == State::kActivating);
}

TransitionEvent transition_event(const Transition& transition) {
  TransitionEvent event;
  event.timestamp(static_cast<std::uint64_t>(clocks::system_ns()));
  event.transition().id(transition.id);
  event.transition().label(transition.label);
  event.start_state(message_of(transition.from));
  event.goal_state(message_of(transition.to));
  return event;
}

/// Selects by label if given, as in rcl_lifecycle.
ChangeState_Response change_state(ControlledNode& node, const PublishTransition& publish,
                                  const ChangeState_Request& request) {
  const auto& wanted = request.transition();
  const auto found = std::ranges::find_if(kTransitions, [&](const Transition& transition) {
    const bool is_it = wanted.label().empty() ? transition.id == wanted.id() : transition.label == wanted.label();
    return is_it && transition.from == state_of(node);
  });
  ChangeState_Response response;
  response.success(found != kTransitions.end() && carry_out(node, found->to));
  if (response.success()) {
    publish(transition_event(*found));
    publish(transition_event(*std::ranges::find(kTransitions, found->to, &Transition::from)));
  }
  return response;
}

/// The response has no field for the reason; it is logged.
ChangeState_Response refuse_to_change(const ChangeState_Request&, const std::string&) {
  ChangeState_Response response;
  response.success(false);
  return response;
}

template <class Request, class Response>
OfferedService offer_lifecycle(const std::string& name, const char* type, ControlledNode& node,
                               Response (*answer)(ControlledNode&, const Request&)) {
  return {
      {name, std::string("lifecycle_msgs/srv/") + type},
      service_handler<Request, Response>([&node, answer](const Request& request) { return answer(node, request); })};
}

}  // namespace

std::vector<OfferedService> lifecycle_services(const std::string& full_name, ControlledNode& node,
                                               PublishTransition publish) {
  OfferedService changes{{full_name + "/change_state", "lifecycle_msgs/srv/ChangeState"},
                         service_handler<ChangeState_Request, ChangeState_Response>(
                             [&node, publish = std::move(publish)](const ChangeState_Request& request) {
                               return change_state(node, publish, request);
                             })};
  changes.refuse = refusal_of(refuse_to_change);
  return {std::move(changes), offer_lifecycle(full_name + "/get_state", "GetState", node, get_state),
          offer_lifecycle(full_name + "/get_available_states", "GetAvailableStates", node, get_states),
          offer_lifecycle(full_name + "/get_available_transitions", "GetAvailableTransitions", node, get_transitions),
          offer_lifecycle(full_name + "/get_transition_graph", "GetAvailableTransitions", node, get_graph)};
}

}  // namespace panvo::runtime::node_services
