// SPDX-License-Identifier: Apache-2.0
#include "doctor/graph_checks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace panvo::runtime::doctor {
namespace {

using interfaces::Durability;
using interfaces::Reliability;
using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Nodes "/talker" and "/listener" with an endpoint each.
class Domain : public testing::Test {
 protected:
  Domain() {
    graph.participants = {"p1", "p2"};
    graph.nodes = {{"/", "talker", {}, {"w"}}, {"/", "listener", {"r"}, {}}};
    graph.endpoints = {{.kind = EndpointKind::kTopic,
                        .name = "/chatter",
                        .type_name = "std_msgs/msg/String",
                        .is_writer = true,
                        .qos = {},
                        .type_hash = "RIHS01_1",
                        .gid = "w"},
                       {.kind = EndpointKind::kTopic,
                        .name = "/chatter",
                        .type_name = "std_msgs/msg/String",
                        .is_writer = false,
                        .qos = {},
                        .type_hash = "RIHS01_1",
                        .gid = "r"}};
  }
  GraphEndpoint& writer() { return graph.endpoints[0]; }
  GraphEndpoint& reader() { return graph.endpoints[1]; }

  static auto problem(const std::string& text) {
    return AllOf(Field(&Finding::severity, Severity::kProblem), Field(&Finding::text, HasSubstr(text)),
                 Field(&Finding::remedy, Not(IsEmpty())));
  }

  Graph graph;
};

TEST_F(Domain, InOrderIsOneFinding) {
  EXPECT_THAT(check_graph(graph), ElementsAre(AllOf(Field(&Finding::severity, Severity::kOk),
                                                    Field(&Finding::text, "2 nodes in 2 processes, no conflicts"))));
}

TEST_F(Domain, WithNodesOfOneName) {
  graph.nodes[1].name = "talker";
  EXPECT_THAT(check_graph(graph), ElementsAre(problem("2 nodes are named /talker")));
}

TEST_F(Domain, WithATopicOfTwoTypes) {
  reader().type_name = "std_msgs/msg/Header";
  EXPECT_THAT(check_graph(graph),
              ElementsAre(problem("std_msgs/msg/Header (/listener) std_msgs/msg/String (/talker)")));
}

TEST_F(Domain, WithQualityOfServiceThatDoesNotFit) {
  writer().qos.requested = Reliability::kBestEffort;
  reader().qos.requested = Reliability::kReliable;
  EXPECT_THAT(check_graph(graph),
              ElementsAre(problem("/chatter: /listener receives nothing from /talker: it requests reliable")));
  std::swap(writer().qos, reader().qos);
  EXPECT_THAT(check_graph(graph), ElementsAre(Field(&Finding::severity, Severity::kOk)));
  writer().qos.durability = Durability::kVolatile;
  reader().qos.durability = Durability::kTransientLocal;
  EXPECT_THAT(check_graph(graph), ElementsAre(problem("it requests earlier messages")));
}

TEST_F(Domain, WithTwoClocks) {
  GraphEndpoint clock = writer();
  clock.name = "/clock";
  clock.type_name = "rosgraph_msgs/msg/Clock";
  graph.endpoints.push_back(clock);
  EXPECT_THAT(check_graph(graph), ElementsAre(Field(&Finding::severity, Severity::kOk)));
  clock.gid = "other";
  graph.endpoints.push_back(clock);
  EXPECT_THAT(check_graph(graph), ElementsAre(problem("2 publishers of /clock")));
}

TEST_F(Domain, WithHumbleAndALaterDistribution) {
  GraphEndpoint nodes{.kind = EndpointKind::kOther,
                      .name = kNodesTopic,
                      .type_name = "ParticipantEntitiesInfo",
                      .is_writer = false,
                      .qos = {},
                      .type_hash = "RIHS01_2",
                      .gid = "n"};
  graph.endpoints.push_back(nodes);
  EXPECT_THAT(check_graph(graph), ElementsAre(Field(&Finding::severity, Severity::kOk)));
  nodes.type_hash = "";
  graph.endpoints.push_back(nodes);
  EXPECT_THAT(check_graph(graph), ElementsAre(Field(&Finding::severity, Severity::kWarning)));
}

}  // namespace
}  // namespace panvo::runtime::doctor
