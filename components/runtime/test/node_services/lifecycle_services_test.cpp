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
  std::vector<std::string> transitions() {
    std::vector<std::string> found;
    const auto response =
        ask<GetAvailableTransitions_Response>(services, "get_available_transitions", GetAvailableTransitions_Request());
    for (const auto& one : response.available_transitions())
      found.push_back(one.transition().label() + " to " + one.goal_state().label());
    return found;
  }

  FakeNode node;
  const std::vector<OfferedService> services = lifecycle_services("/tracker", node);
};

TEST_F(LifecycleServices, BeginActive) {
  EXPECT_EQ(state(), "active");
  EXPECT_THAT(transitions(), ElementsAre("deactivate to inactive", "shutdown to finalized"));
}

TEST_F(LifecycleServices, DeactivateAndActivateByNumber) {
  constexpr std::uint8_t kActivate = 3, kDeactivate = 4;
  EXPECT_FALSE(change(kActivate));
  EXPECT_TRUE(change(kDeactivate));
  EXPECT_EQ(state(), "inactive");
  EXPECT_FALSE(node.active);
  EXPECT_FALSE(change(kDeactivate));
  EXPECT_THAT(transitions(), ElementsAre("activate to active", "shutdown to finalized"));
  EXPECT_TRUE(change(kActivate));
  EXPECT_EQ(state(), "active");
}

TEST_F(LifecycleServices, ChangeByLabelWhereThereIsOne) {
  EXPECT_TRUE(change(0, "deactivate"));
  EXPECT_EQ(state(), "inactive");
  EXPECT_TRUE(change(0, "shutdown"));
  EXPECT_TRUE(node.is_shut_down);
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
  EXPECT_THAT(labels, ElementsAre("inactive", "active", "finalized"));
}

}  // namespace
}  // namespace panvo::runtime::node_services
