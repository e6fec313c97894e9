// SPDX-License-Identifier: Apache-2.0
// Access rights of service requests.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "composition_interfaces/srv/LoadNode.h"
#include "fake_node.hpp"
#include "lifecycle_msgs/srv/ChangeState.h"
#include "rcl_interfaces/srv/SetParameters.h"
#include "rcl_interfaces/srv/SetParametersAtomically.h"

namespace panvo::runtime::node_services {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr Caller kHere{.is_on_this_host = true}, kElsewhere{.is_on_this_host = false};

class NoContainer final : public ControlledContainer {
 public:
  Loaded load_component(const ComponentDescription&) override { return {}; }
  void unload_component(std::uint64_t) override {}
  std::vector<Loaded> loaded_components() const override { return {}; }
};

class ServiceAccessTo : public testing::Test {
 protected:
  ServiceAccessTo() {
    for (auto& service : lifecycle_services("/node", node, [](const auto&) {})) services.push_back(std::move(service));
    for (auto& service : component_services("/container", container)) services.push_back(std::move(service));
  }

  const OfferedService& service(const std::string& end) const {
    for (const auto& one : services) {
      if (one.description.name.ends_with("/" + end)) return one;
    }
    throw std::runtime_error("there is no service " + end);
  }

  /// The guard's answer to a request from another host with default settings.
  template <class Response, class Request>
  Response refusal(const std::string& end, const Request& request) const {
    const auto answer = guard_of(service(end), ServiceAccess::kByHost)(to_bytes(request), kElsewhere);
    if (!answer) throw std::runtime_error(end + " is not refused");
    return from_bytes<Response>(*answer);
  }

  FakeNode node;
  NoContainer container;
  std::vector<OfferedService> services = parameter_services("/node", node);
};

TEST_F(ServiceAccessTo, ThisHostMaySteerAndOthersLookWhereNothingIsSaid) {
  EXPECT_FALSE(control_problem(ServiceAccess::kByHost, kHere));
  EXPECT_THAT(control_problem(ServiceAccess::kByHost, kElsewhere).value_or(""), HasSubstr("services: steer"));
}

TEST_F(ServiceAccessTo, WhatTheSystemFileSaysHoldsForAllHosts) {
  for (const Caller& caller : {kHere, kElsewhere}) {
    EXPECT_TRUE(control_problem(ServiceAccess::kLook, caller));
    EXPECT_FALSE(control_problem(ServiceAccess::kSteer, caller));
  }
}

TEST_F(ServiceAccessTo, WhateverChangesSomethingIsGuardedAndNothingElse) {
  std::set<std::string> guarded;
  for (const auto& one : services) {
    if (guard_of(one, ServiceAccess::kLook)) guarded.insert(one.description.name);
  }
  EXPECT_EQ(guarded,
            (std::set<std::string>{"/node/set_parameters", "/node/set_parameters_atomically", "/node/change_state",
                                   "/container/_container/load_node", "/container/_container/unload_node"}));
}

TEST_F(ServiceAccessTo, ARefusalSaysSoInTheTermsOfEachService) {
  rcl_interfaces::srv::SetParameters_Request set;
  set.parameters().resize(2);
  const auto results = refusal<rcl_interfaces::srv::SetParameters_Response>("set_parameters", set).results();
  ASSERT_EQ(results.size(), 2U);
  EXPECT_FALSE(results[1].successful());
  EXPECT_THAT(results[1].reason(), HasSubstr("refused"));
  const auto together = refusal<rcl_interfaces::srv::SetParametersAtomically_Response>(
      "set_parameters_atomically", rcl_interfaces::srv::SetParametersAtomically_Request());
  EXPECT_FALSE(together.result().successful());
  EXPECT_THAT(together.result().reason(), HasSubstr("refused"));
  EXPECT_FALSE(
      refusal<lifecycle_msgs::srv::ChangeState_Response>("change_state", lifecycle_msgs::srv::ChangeState_Request())
          .success());
  const auto loaded = refusal<composition_interfaces::srv::LoadNode_Response>(
      "load_node", composition_interfaces::srv::LoadNode_Request());
  EXPECT_FALSE(loaded.success());
  EXPECT_THAT(loaded.error_message(), HasSubstr("refused"));
  EXPECT_TRUE(node.asked.empty());
}

TEST_F(ServiceAccessTo, WhoMayIsNotRefused) {
  const auto guard = guard_of(service("change_state"), ServiceAccess::kByHost);
  EXPECT_FALSE(guard(to_bytes(lifecycle_msgs::srv::ChangeState_Request()), kHere));
}

}  // namespace
}  // namespace panvo::runtime::node_services
