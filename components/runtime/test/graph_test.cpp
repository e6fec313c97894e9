// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/graph.hpp"

#include <gtest/gtest.h>

namespace panvo::runtime {
namespace {

const std::string kParticipant(24, 'a');

GraphEndpoint endpoint(const std::string& id, const std::string& name, bool is_writer = true) {
  GraphEndpoint endpoint;
  endpoint.name = name;
  endpoint.is_writer = is_writer;
  endpoint.gid = kParticipant + id;
  return endpoint;
}

struct GraphOfATalker : testing::Test {
  Graph graph{{{"/", "talker", {kParticipant + "00000004"}, {kParticipant + "00000003"}}},
              {endpoint("00000001", "ros_discovery_info"), endpoint("00000003", "/chatter"),
               endpoint("00000004", "/set", false)},
              {kParticipant}};
};

TEST_F(GraphOfATalker, IsCompleteWithNodeAndEndpoints) { EXPECT_TRUE(is_complete(graph)); }

TEST_F(GraphOfATalker, LacksAnEndpointThatItsNodeTellsOf) {
  graph.endpoints.erase(graph.endpoints.begin() + 1);
  EXPECT_FALSE(is_complete(graph));
  graph.endpoints.push_back(endpoint("00000003", "/chatter"));
  EXPECT_TRUE(is_complete(graph));
  graph.endpoints.erase(graph.endpoints.begin() + 1);
  EXPECT_FALSE(is_complete(graph));
}

TEST_F(GraphOfATalker, LacksTheNode) {
  graph.nodes.clear();
  EXPECT_FALSE(is_complete(graph));
}

TEST_F(GraphOfATalker, LacksAllOfAParticipant) {
  graph.participants.push_back(std::string(24, 'b'));
  EXPECT_FALSE(is_complete(graph));
}

TEST_F(GraphOfATalker, LacksNothingOfADiscoveryServer) {
  graph.participants.emplace_back("4453005f4550524f53494d41");
  EXPECT_TRUE(is_complete(graph));
}

TEST(GraphOfNobody, IsComplete) { EXPECT_TRUE(is_complete({})); }

}  // namespace
}  // namespace panvo::runtime
