// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fake_node.hpp"
#include "lifecycle_msgs/srv/ChangeState.h"
#include "lifecycle_msgs/srv/GetAvailableStates.h"
#include "lifecycle_msgs/srv/GetAvailableTransitions.h"
#include "lifecycle_msgs/srv/GetState.h"

namespace panvo::runtime::node_services {
namespace {

using namespace lifecycle_msgs::srv;
using testing::ElementsAre;

class LifecycleServices : public testing::Test {
 protected:
  std::string state() {
    return ask<GetState_Response>(services, "get_state", GetState_Request()).current_state().label();
  }
  bool change(std::uint8_t id, const std::string& label = "") {
    ChangeState_Request request;
    request.transition().id(id);
    request.transition().label(label);
    return ask<ChangeState_Response>(services, "change_state", request).success();
  }
  std::vector<std::string> transitions(const std::string& service = "get_available_transitions") {
    std::vector<std::string> found;
    const auto response = ask<GetAvailableTransitions_Response>(services, service, GetAvailableTransitions_Request());
    for (const auto& one : response.available_transitions())
      found.push_back(one.transition().label() + " to " + one.goal_state().label());
    return found;
  }

  FakeNode node;
  std::vector<std::string> told;
  const std::vector<OfferedService> services =
      lifecycle_services("/tracker", node, [this](const lifecycle_msgs::msg::TransitionEvent& event) {
        told.push_back(std::to_string(event.transition().id()) + ": " + event.start_state().label() + " to " +
                       event.goal_state().label());
      });
};

TEST_F(LifecycleServices, BeginActive) {
  EXPECT_EQ(state(), "active");
  EXPECT_THAT(transitions(), ElementsAre("deactivate to deactivating", "shutdown to shuttingdown"));
}

TEST_F(LifecycleServices, DeactivateAndActivateByNumber) {
  constexpr std::uint8_t kActivate = 3, kDeactivate = 4;
  EXPECT_FALSE(change(kActivate));
  EXPECT_TRUE(change(kDeactivate));
  EXPECT_EQ(state(), "inactive");
  EXPECT_FALSE(node.active);
  EXPECT_FALSE(change(kDeactivate));
  EXPECT_THAT(transitions(), ElementsAre("activate to activating", "shutdown to shuttingdown"));
  EXPECT_TRUE(change(kActivate));
  EXPECT_EQ(state(), "active");
}

TEST_F(LifecycleServices, ChangeByLabelWhereThereIsOne) {
  EXPECT_TRUE(change(0, "deactivate"));
  EXPECT_EQ(state(), "inactive");
  EXPECT_TRUE(change(0, "shutdown"));
  EXPECT_TRUE(node.is_over);
}

TEST_F(LifecycleServices, EndFinalized) {
  EXPECT_TRUE(change(0, "shutdown"));
  EXPECT_EQ(state(), "finalized");
  EXPECT_THAT(transitions(), testing::IsEmpty());
  EXPECT_FALSE(change(0, "activate"));
  EXPECT_FALSE(change(0, "shutdown"));
}

TEST_F(LifecycleServices, TellEachTransitionInTwoStepsAsRos2) {
  EXPECT_TRUE(change(0, "deactivate"));
  EXPECT_THAT(told, ElementsAre("4: active to deactivating", "40: deactivating to inactive"));
  told.clear();
  EXPECT_FALSE(change(0, "deactivate"));
  EXPECT_THAT(told, testing::IsEmpty());
  EXPECT_TRUE(change(0, "shutdown"));
  EXPECT_THAT(told, ElementsAre("6: inactive to shuttingdown", "50: shuttingdown to finalized"));
}

TEST_F(LifecycleServices, TellAllTransitions) {
  EXPECT_THAT(transitions("get_transition_graph"),
              ElementsAre("activate to activating", "transition_success to active", "deactivate to deactivating",
                          "transition_success to inactive", "shutdown to shuttingdown", "shutdown to shuttingdown",
                          "transition_success to finalized"));
}

TEST_F(LifecycleServices, HaveNothingToConfigure) {
  constexpr std::uint8_t kConfigure = 1, kCleanUp = 2;
  EXPECT_FALSE(change(kConfigure));
  EXPECT_FALSE(change(kCleanUp));
  EXPECT_FALSE(change(0, "configure"));
}

TEST_F(LifecycleServices, SayWhenTheNodeCannot) {
  node.refusal = "plays something";
  EXPECT_FALSE(change(0, "deactivate"));
  EXPECT_EQ(state(), "active");
}

TEST_F(LifecycleServices, TellTheStatesThereAre) {
  std::vector<std::string> labels;
  const auto response =
      ask<GetAvailableStates_Response>(services, "get_available_states", GetAvailableStates_Request());
  for (const auto& one : response.available_states()) labels.push_back(one.label());
  EXPECT_THAT(labels, ElementsAre("inactive", "active", "finalized", "shuttingdown", "activating", "deactivating"));
}

}  // namespace
}  // namespace panvo::runtime::node_services
