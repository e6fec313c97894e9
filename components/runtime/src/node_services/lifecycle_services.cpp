// SPDX-License-Identifier: Apache-2.0
// Component states in the terms of ROS 2's managed nodes: a component starts configured and active; inactive, it gets
// no messages; shut down, it is unloaded. Configuring again and cleaning up do not apply.
#include <algorithm>
#include <array>

#include "lifecycle_msgs/srv/ChangeState.h"
#include "lifecycle_msgs/srv/GetAvailableStates.h"
#include "lifecycle_msgs/srv/GetAvailableTransitions.h"
#include "lifecycle_msgs/srv/GetState.h"
#include "node_services/controlled.hpp"

namespace panvo::runtime::node_services {
namespace {

using namespace lifecycle_msgs::srv;  // NOLINT(google-build-using-namespace): as in parameter_services.cpp

// The constants of lifecycle_msgs/msg/State and Transition.
enum class State : std::uint8_t { kInactive = 2, kActive = 3, kFinalized = 4 };
enum class Change : std::uint8_t { kActivate, kDeactivate, kShutDown };

struct Transition {
  Change change;
  std::uint8_t id;
  const char* label;
  State from, to;
};
constexpr std::array<Transition, 4> kTransitions{
    {{Change::kActivate, 3, "activate", State::kInactive, State::kActive},
     {Change::kDeactivate, 4, "deactivate", State::kActive, State::kInactive},
     {Change::kShutDown, 6, "shutdown", State::kInactive, State::kFinalized},
     {Change::kShutDown, 7, "shutdown", State::kActive, State::kFinalized}}};

lifecycle_msgs::msg::State message_of(State state) {
  lifecycle_msgs::msg::State message;
  message.id(static_cast<std::uint8_t>(state));
  message.label(state == State::kActive ? "active" : state == State::kInactive ? "inactive" : "finalized");
  return message;
}

State state_of(const ControlledNode& node) { return node.is_active() ? State::kActive : State::kInactive; }

GetState_Response get_state(ControlledNode& node, const GetState_Request&) {
  GetState_Response response;
  response.current_state(message_of(state_of(node)));
  return response;
}

GetAvailableStates_Response get_states(ControlledNode&, const GetAvailableStates_Request&) {
  GetAvailableStates_Response response;
  for (const State state : {State::kInactive, State::kActive, State::kFinalized})
    response.available_states().push_back(message_of(state));
  return response;
}

GetAvailableTransitions_Response get_transitions(ControlledNode& node, const GetAvailableTransitions_Request&) {
  GetAvailableTransitions_Response response;
  for (const auto& transition : kTransitions) {
    if (transition.from != state_of(node)) continue;
    lifecycle_msgs::msg::TransitionDescription description;
    description.transition().id(transition.id);
    description.transition().label(transition.label);
    description.start_state(message_of(transition.from));
    description.goal_state(message_of(transition.to));
    response.available_transitions().push_back(description);
  }
  return response;
}

bool carry_out(ControlledNode& node, Change change) {
  return change == Change::kShutDown ? node.shut_down() : node.set_active(change == Change::kActivate);
}

/// Selects by label if given, as in rcl_lifecycle.
ChangeState_Response change_state(ControlledNode& node, const ChangeState_Request& request) {
  const auto& wanted = request.transition();
  const auto found = std::ranges::find_if(kTransitions, [&](const Transition& transition) {
    const bool is_it = wanted.label().empty() ? transition.id == wanted.id() : transition.label == wanted.label();
    return is_it && transition.from == state_of(node);
  });
  ChangeState_Response response;
  response.success(found != kTransitions.end() && carry_out(node, found->change));
  return response;
}

/// The response has no field for the reason; it is logged.
ChangeState_Response refuse_to_change(const ChangeState_Request&, const std::string&) {
  ChangeState_Response response;
  response.success(false);
  return response;
}

template <class Request, class Response>
OfferedService offer(const std::string& name, const char* type, ControlledNode& node,
                     Response (*answer)(ControlledNode&, const Request&)) {
  return {
      {name, std::string("lifecycle_msgs/srv/") + type},
      service_handler<Request, Response>([&node, answer](const Request& request) { return answer(node, request); })};
}

}  // namespace

std::vector<OfferedService> lifecycle_services(const std::string& full_name, ControlledNode& node) {
  auto changes = offer(full_name + "/change_state", "ChangeState", node, change_state);
  changes.refuse = refusal_of(refuse_to_change);
  return {std::move(changes), offer(full_name + "/get_state", "GetState", node, get_state),
          offer(full_name + "/get_available_states", "GetAvailableStates", node, get_states),
          offer(full_name + "/get_available_transitions", "GetAvailableTransitions", node, get_transitions)};
}

}  // namespace panvo::runtime::node_services
