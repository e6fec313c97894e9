// SPDX-License-Identifier: Apache-2.0
// Nodes as seen by ROS 2 tools.
#include <algorithm>
#include <csignal>

#include "bridge_fixture.hpp"
#include "dds/fast_dds.hpp"
#include "dds/node_graph.hpp"
#include "dds/node_info.hpp"
#include "dds/participant.hpp"
#include "panvo/runtime/graph.hpp"
#include "rmw_dds_common/msg/ParticipantEntitiesInfo.h"
#include "service_messages.hpp"

namespace panvo::runtime::test {
namespace {

dds::NodeInfo some_info() {
  dds::NodeInfo info;
  for (int i = 0; i < 12; ++i) info.participant.guidPrefix.value[i] = static_cast<std::uint8_t>(i + 1);
  dds::NodeInfo::Node node{"/robot", "tracker", {info.participant}, {info.participant, info.participant}};
  node.readers[0].entityId.value[3] = 4;
  info.nodes = {node, {"/", "other", {}, {}}};
  return info;
}

void expect_equal(const std::optional<dds::NodeInfo>& found, const dds::NodeInfo& wanted) {
  ASSERT_TRUE(found);
  EXPECT_EQ(found->participant, wanted.participant);
  ASSERT_EQ(found->nodes.size(), wanted.nodes.size());
  for (std::size_t i = 0; i < wanted.nodes.size(); ++i) {
    EXPECT_EQ(found->nodes[i].name_space, wanted.nodes[i].name_space);
    EXPECT_EQ(found->nodes[i].name, wanted.nodes[i].name);
    EXPECT_EQ(found->nodes[i].readers, wanted.nodes[i].readers);
    EXPECT_EQ(found->nodes[i].writers, wanted.nodes[i].writers);
  }
}

TEST(NodeInfo, OfJazzyIsWhatTheGeneratedClassWrites) {
  const auto& type = interfaces::message_type<rmw_dds_common::msg::ParticipantEntitiesInfo>();
  const auto bytes = dds::encode(some_info(), dds::kGidSize);
  const auto message = type.deserialize(bytes);
  interfaces::Bytes again(type.serialized_size(message.get()));
  type.serialize(message.get(), again);
  EXPECT_EQ(bytes, again);
}

TEST(NodeInfo, IsReadAsJazzyAndAsHumbleWriteIt) {
  for (const auto size : {dds::kGidSize, dds::kHumbleGidSize}) {
    const auto bytes = dds::encode(some_info(), size);
    expect_equal(dds::decode_node_info(bytes), some_info());
    auto padded = bytes;
    padded.resize((bytes.size() + 3) / 4 * 4);
    expect_equal(dds::decode_node_info(padded), some_info());
  }
  EXPECT_EQ(dds::encode(some_info(), dds::kHumbleGidSize).size(),
            dds::encode(some_info(), dds::kGidSize).size() + 4 * 8);
}

TEST(NodeInfo, OfNoNodesIsReadInEitherSize) {
  auto info = some_info();
  info.nodes.clear();
  for (const std::size_t size : {dds::kGidSize, dds::kHumbleGidSize})
    expect_equal(dds::decode_node_info(dds::encode(info, size)), info);
}

TEST(NodeInfo, CutOffOrDamagedIsRefusedOrReadWithoutHarm) {
  for (const std::size_t size : {dds::kGidSize, dds::kHumbleGidSize}) {
    const auto bytes = dds::encode(some_info(), size);
    for (std::size_t length = 0; length + 4 < bytes.size(); ++length) {
      const bool is_read = dds::decode_node_info({bytes.data(), length}).has_value();
      // The start of a message with long GIDs can be a valid one with short GIDs and no nodes.
      EXPECT_TRUE(size != dds::kGidSize || !is_read) << length;
    }
    for (std::size_t at = 0; at < bytes.size(); ++at) {
      auto damaged = bytes;
      damaged[at] = 255;
      dds::decode_node_info(damaged);
    }
  }
}

class Nodes : public BetweenProcesses {
 protected:
  std::vector<GraphNode> nodes_called(const std::string& name) {
    std::vector<GraphNode> found;
    for (auto& node : bridge->graph().nodes) {
      if (node.name == name) found.push_back(std::move(node));
    }
    return found;
  }
};

TEST_F(Nodes, OfAnotherProcessAreListedOnceWithWhatTheyHave) {
  const auto published = unique_topic("published"), served = unique_topic("served");
  peer.ask("open_writer " + published + " " + kStringType + " reliable transient_local 10");
  peer.ask("serve " + served);
  peer.ask("set_node talker " + published + " " + served);
  ASSERT_TRUE(eventually([&] {
    const auto found = nodes_called("talker");
    return found.size() == 1 && found[0].readers.size() == 1 && found[0].writers.size() == 2;
  }));
  std::vector<GraphEndpoint> endpoints;
  ASSERT_TRUE(eventually([&] {
    endpoints = bridge->graph().endpoints;
    std::erase_if(endpoints, [&](const auto& one) { return one.name != published && one.name != served; });
    return endpoints.size() == 3;
  }));
  const auto node = nodes_called("talker").at(0);
  // ROS 2 looks up the node of an endpoint in the list of the endpoint's participant.
  const auto participant = node.readers.at(0).substr(0, 2 * dds::rtps::GuidPrefix_t::size);
  for (const auto& endpoint : endpoints) {
    EXPECT_TRUE(endpoint.gid.starts_with(participant)) << endpoint.name;
    const auto& gids = endpoint.is_writer ? node.writers : node.readers;
    EXPECT_NE(std::ranges::find(gids, endpoint.gid), gids.end()) << endpoint.name;
    if (endpoint.name == published) {
      EXPECT_EQ(endpoint.kind, EndpointKind::kTopic);
      EXPECT_EQ(endpoint.type_name, kStringType);
      EXPECT_EQ(endpoint.type_hash, interfaces::find_message_type(kStringType)->hash);
      EXPECT_EQ(endpoint.qos.requested, interfaces::Reliability::kReliable);
      EXPECT_EQ(endpoint.qos.durability, interfaces::Durability::kTransientLocal);
    } else {
      EXPECT_EQ(endpoint.kind, endpoint.is_writer ? EndpointKind::kReply : EndpointKind::kRequest);
      EXPECT_EQ(endpoint.type_name, kServiceType);
    }
  }
}

TEST_F(Nodes, AreToldAnewWhenEndpointsCome) {
  const auto published = unique_topic("late");
  bridge->graph();
  peer.ask("set_node talker " + published + " " + unique_topic("none"));
  ASSERT_TRUE(eventually([&] { return nodes_called("talker").size() == 1; }));
  EXPECT_TRUE(nodes_called("talker")[0].writers.empty());
  peer.ask("open_writer " + published + " " + kStringType + " reliable volatile 10");
  EXPECT_TRUE(eventually([&] { return nodes_called("talker").at(0).writers.size() == 1; }));
}

TEST_F(Nodes, AreListedThoughTheirProcessTellsOfThemMoreOftenThanATopicMay) {
  constexpr int kMoreThanABurst = 2000;
  const auto careful =
      make_dds_bridge({.domain = domain, .profiles = "", .name = "careful", .limits = {.max_topic_rate_hz = 1e-3}});
  careful->graph();
  peer.ask("open_nodes_writer robot");
  ASSERT_TRUE(peer.matches("robot", 1));
  peer.ask("write_nodes robot starting " + std::to_string(kMoreThanABurst));
  peer.ask("write_nodes robot started 1");
  EXPECT_TRUE(eventually([&] {
    const auto nodes = careful->graph().nodes;
    return nodes.size() == 1 && nodes[0].name == "started";
  }));
}

TEST_F(Nodes, OfThisProcessAreSeenByAnother) {
  bridge->set_nodes({{"/robot", "tracker", {}, {}, {}}});
  EXPECT_TRUE(eventually([&] { return peer.ask("nodes") == "nodes /robot tracker 0 0"; }));
}

TEST_F(Nodes, AreToldAsHumbleReadsThem) {
  const auto humble = make_dds_bridge({.domain = domain, .profiles = "", .name = "humble", .ros_distro = "humble"});
  humble->set_nodes({{"/robot", "old", {}, {}, {}}});
  EXPECT_TRUE(eventually([&] { return peer.ask("nodes") == "nodes /robot old 0 0"; }));
}

TEST_F(Nodes, AreToldToHumblesNodesOnlyAsTheyReadThem) {
  dds::NodeInfo info;
  info.nodes = {{"/robot", "tracker", {}, {}}};
  const auto size = [&](std::size_t gid_size) { return std::to_string(dds::encode(info, gid_size).size()); };
  bridge->set_nodes({{"/robot", "tracker", {}, {}, {}}});
  peer.ask("open_nodes_reader jazzy typehash=RIHS01_0;");
  EXPECT_EQ(peer.next_received("jazzy"), size(dds::kGidSize));
  // The message for Jazzy is kept for late readers. One of Humble would be killed by it.
  PeerProcess humble_peer(domain);
  humble_peer.ask("open_nodes_reader humble");
  EXPECT_EQ(humble_peer.next_received("humble"), size(dds::kHumbleGidSize));
  EXPECT_EQ(peer.next_received("jazzy"), size(dds::kHumbleGidSize));
  EXPECT_TRUE(is_warned_of("Humble", "Remedy"));
  humble_peer.ask("close_nodes_reader humble");
  EXPECT_EQ(peer.next_received("jazzy"), size(dds::kGidSize));
}

TEST_F(Nodes, AreGoneWithTheirProcess) {
  {
    PeerProcess second_peer(domain);
    second_peer.ask("set_node short_lived /a /b");
    ASSERT_TRUE(eventually([&] { return nodes_called("short_lived").size() == 1; }));
  }
  EXPECT_TRUE(eventually([&] { return nodes_called("short_lived").empty(); }));
}

TEST_F(Nodes, OfOneNameInTwoProcessesAreWarnedOf) {
  bridge->set_nodes({{"/", "twin", {}, {}, {}}});
  peer.ask("set_node twin /a /b");
  EXPECT_TRUE(is_warned_of("node /twin", "Remedy"));
}

TEST(NodeGraph, ThatIsClosedHasNoEndpointsThoughACallbackOfFastDdsStillHoldsIt) {
  const auto notifier = std::make_shared<dds::Notifier>();
  const auto endpoints = std::make_shared<dds::LocalEndpoints>();
  const DdsSettings settings{.domain = test_domain(), .profiles = "", .name = "panvo_test"};
  auto participant = std::make_shared<dds::Participant>(settings, dds::Hears::kMatching,
                                                        std::make_shared<dds::Discovery>(notifier), endpoints);
  const auto graph = std::make_shared<dds::NodeGraph>(notifier, endpoints, false);
  graph->open_writer(participant);
  graph->open_reader(participant);
  const std::weak_ptr<dds::Participant> used = participant;
  participant.reset();
  EXPECT_FALSE(used.expired());
  notifier->stop();
  graph->close();
  EXPECT_TRUE(used.expired()) << "ended on a thread of Fast DDS, an endpoint waits for that thread";
}

}  // namespace
}  // namespace panvo::runtime::test
