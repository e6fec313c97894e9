// SPDX-License-Identifier: Apache-2.0
// A container in another process, controlled by services like ROS 2 tools do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "composition_interfaces/srv/ListNodes.h"
#include "composition_interfaces/srv/LoadNode.h"
#include "composition_interfaces/srv/UnloadNode.h"
#include "inbox.hpp"
#include "lifecycle_msgs/msg/TransitionEvent.h"
#include "lifecycle_msgs/srv/ChangeState.h"
#include "lifecycle_msgs/srv/GetState.h"
#include "node_service_topics.hpp"
#include "panvo/interfaces/topic.hpp"
#include "panvo/runtime/bridge.hpp"
#include "panvo/runtime/graph.hpp"
#include "peer_process.hpp"
#include "rcl_interfaces/msg/ParameterEvent.h"
#include "rcl_interfaces/srv/GetParameters.h"
#include "rcl_interfaces/srv/ListParameters.h"
#include "rcl_interfaces/srv/SetParameters.h"

namespace panvo::runtime::test {
namespace {

using composition_interfaces::srv::ListNodes_Request;
using composition_interfaces::srv::ListNodes_Response;
using composition_interfaces::srv::LoadNode_Request;
using composition_interfaces::srv::LoadNode_Response;
using composition_interfaces::srv::UnloadNode_Request;
using composition_interfaces::srv::UnloadNode_Response;
using testing::HasSubstr;

class NodeServices : public testing::Test {
 protected:
  /// The other process answers once its container exists, and loads components on request once it runs.
  void SetUp() override {
    ASSERT_TRUE(eventually([&] { return !loaded().empty(); }));
    auto none = relay();
    none.package_name("panvo_nothing");
    ASSERT_TRUE(eventually([&] { return load(none).error_message().find("still loading") == std::string::npos; }));
  }

  template <class Response, class Request>
  Response ask(const std::string& name, const std::string& type, const Request& request) {
    auto& client = clients[name];
    if (!client) client = bridge->open_client({name, type});
    if (!client->wait_for_service(kLimit)) throw std::runtime_error(name + " is not there");
    const auto answer = client->call(to_bytes(request), kLimit);
    if (!answer) throw std::runtime_error(name + " does not answer");
    return from_bytes<Response>(*answer);
  }
  LoadNode_Response load(const LoadNode_Request& request) {
    return ask<LoadNode_Response>("/controlled/_container/load_node", "composition_interfaces/srv/LoadNode", request);
  }
  UnloadNode_Response unload(std::uint64_t id) {
    UnloadNode_Request request;
    request.unique_id(id);
    return ask<UnloadNode_Response>("/controlled/_container/unload_node", "composition_interfaces/srv/UnloadNode",
                                    request);
  }
  std::vector<std::string> loaded() {
    return ask<ListNodes_Response>("/controlled/_container/list_nodes", "composition_interfaces/srv/ListNodes",
                                   ListNodes_Request())
        .full_node_names();
  }
  static LoadNode_Request relay() {
    LoadNode_Request request;
    request.package_name("panvo_test_relay");
    request.plugin_name("RelayComponent");
    request.node_name("relay");
    return request;
  }
  bool change_state(const std::string& label) {
    lifecycle_msgs::srv::ChangeState_Request request;
    request.transition().label(label);
    return ask<lifecycle_msgs::srv::ChangeState_Response>("/robot/echo/change_state", "lifecycle_msgs/srv/ChangeState",
                                                          request)
        .success();
  }
  std::string state() {
    return ask<lifecycle_msgs::srv::GetState_Response>("/robot/echo/get_state", "lifecycle_msgs/srv/GetState",
                                                       lifecycle_msgs::srv::GetState_Request())
        .current_state()
        .label();
  }
  std::string set_before(const std::string& text) {
    rcl_interfaces::srv::SetParameters_Request request;
    request.parameters().resize(1);
    request.parameters()[0].name("before");
    request.parameters()[0].value().type(4);  // a string
    request.parameters()[0].value().string_value(text);
    const auto results = ask<rcl_interfaces::srv::SetParameters_Response>("/robot/echo/set_parameters",
                                                                          "rcl_interfaces/srv/SetParameters", request)
                             .results();
    return results.at(0).successful() ? "" : results.at(0).reason();
  }

  void open_topics() {
    const auto describe = [](const interfaces::Topic<std_msgs::msg::String>& topic) {
      return test::topic(std::string(topic.name), "std_msgs/msg/String", topic.qos);
    };
    reader = bridge->open_reader(describe(kEchoed), echoed.callback());
    writer = bridge->open_writer(describe(kToEcho));
    ASSERT_TRUE(eventually([&] { return writer->matched_readers() == 1 && reader->matched_writers() == 1; }));
    // A match here does not imply a match there, before which messages are lost.
    ASSERT_TRUE(eventually([&] { return writer->write(text_sample("any")) && !echoed.items().empty(); }));
    ASSERT_TRUE(writer->write(text_sample("end")));
    ASSERT_TRUE(echoed.wait_for([](const SamplePtr& sample) { return text_of(sample) == "end"; }));
    echoed.clear();
  }
  static std::string text_of(const SamplePtr& sample) { return Sample::as<std_msgs::msg::String>(sample)->data(); }

  DdsSettings settings() const {
    DdsSettings settings{.domain = domain, .profiles = "", .name = "panvo_test"};
    settings.limits.max_topic_rate_hz = 1e6;  // the peer answers as fast as it can
    return settings;
  }

  const int domain = test_domain();
  PeerProcess peer{domain, PANVO_CONTAINER_PEER};
  Inbox<SamplePtr> echoed;
  std::unique_ptr<Bridge> bridge = make_dds_bridge(settings());
  std::map<std::string, std::unique_ptr<BridgeClient>> clients;
  std::unique_ptr<BridgeReader> reader;
  std::unique_ptr<BridgeWriter> writer;
};

TEST_F(NodeServices, LoadsListsAndUnloads) {
  auto request = relay();
  request.node_namespace("/robot");
  request.parameters().resize(1);
  request.parameters()[0].name("copies");
  request.parameters()[0].value().type(2);  // an integer
  request.parameters()[0].value().integer_value(7);
  const auto response = load(request);
  ASSERT_TRUE(response.success()) << response.error_message();
  EXPECT_EQ(response.full_node_name(), "/robot/relay");
  EXPECT_THAT(loaded(), testing::ElementsAre("/robot/echo", "/robot/relay"));

  rcl_interfaces::srv::GetParameters_Request names;
  names.names({"copies"});
  const auto values = ask<rcl_interfaces::srv::GetParameters_Response>("/robot/relay/get_parameters",
                                                                       "rcl_interfaces/srv/GetParameters", names)
                          .values();
  EXPECT_EQ(values.at(0).integer_value(), 7);

  EXPECT_TRUE(unload(response.unique_id()).success());
  EXPECT_THAT(loaded(), testing::ElementsAre("/robot/echo"));
  EXPECT_THAT(unload(response.unique_id()).error_message(), HasSubstr("no component"));
}

TEST_F(NodeServices, SaysWhyAComponentCannotBeLoaded) {
  auto request = relay();
  request.package_name("panvo_nothing");
  EXPECT_THAT(load(request).error_message(), HasSubstr("panvo_nothing has no plugin"));
  request = relay();
  request.parameters().resize(1);
  request.parameters()[0].name("copies");
  request.parameters()[0].value().type(2);
  request.parameters()[0].value().integer_value(1000);
  EXPECT_THAT(load(request).error_message(), HasSubstr("must be 1..100"));
  request = relay();
  request.node_name("echo");
  EXPECT_THAT(load(request).error_message(), HasSubstr("already"));
  EXPECT_THAT(loaded(), testing::ElementsAre("/robot/echo"));
}

TEST_F(NodeServices, SetsAParameterBetweenTwoMessages) {
  open_topics();
  ASSERT_TRUE(writer->write(text_sample("one")));
  ASSERT_EQ(echoed.wait_for_count(1).size(), 1U);
  EXPECT_EQ(set_before("new:"), "");
  ASSERT_TRUE(writer->write(text_sample("two")));
  const auto items = echoed.wait_for_count(2);
  ASSERT_EQ(items.size(), 2U);
  EXPECT_EQ(text_of(items[0]), "one");
  EXPECT_EQ(text_of(items[1]), "new:two");
}

TEST_F(NodeServices, HandsNoMessagesToAnInactiveComponent) {
  open_topics();
  ASSERT_TRUE(change_state("deactivate"));
  ASSERT_TRUE(writer->write(text_sample("off")));
  ASSERT_TRUE(writer->wait_for_acknowledgments(kLimit));
  EXPECT_EQ(state(), "inactive");
  ASSERT_TRUE(change_state("activate"));
  ASSERT_TRUE(writer->write(text_sample("yes")));
  ASSERT_EQ(echoed.wait_for_count(1).size(), 1U);
  EXPECT_EQ(text_of(echoed.items()[0]), "yes");
}

TEST_F(NodeServices, TellsOfParametersThatComeAndThatAreSet) {
  Inbox<SamplePtr> events;
  const auto listener = bridge->open_reader(
      test::topic("/parameter_events", "rcl_interfaces/msg/ParameterEvent", {.depth = 1000}), events.callback());
  const auto is_told = [&](const auto& is_it) {
    return events.wait_for(
        [&](const SamplePtr& sample) { return is_it(*Sample::as<rcl_interfaces::msg::ParameterEvent>(sample)); });
  };
  const auto tells_before = [](const std::string& text) {
    return [text](const rcl_interfaces::msg::ParameterEvent& event) {
      return event.node() == "/robot/echo" && event.changed_parameters().size() == 1 &&
             event.changed_parameters()[0].name() == "before" &&
             event.changed_parameters()[0].value().string_value() == text;
    };
  };
  // A match here does not imply a match there.
  ASSERT_TRUE(eventually([&] { return set_before("any").empty() && !events.items().empty(); }));
  EXPECT_EQ(set_before("> "), "");
  EXPECT_TRUE(is_told(tells_before("> ")));
  events.clear();
  const auto id = load(relay()).unique_id();
  EXPECT_TRUE(is_told([](const rcl_interfaces::msg::ParameterEvent& event) {
    return event.node() == "/relay" && !event.new_parameters().empty() &&
           event.new_parameters()[0].name() == "copies" && event.new_parameters()[0].value().integer_value() == 1;
  }));
  EXPECT_TRUE(unload(id).success());
}

TEST_F(NodeServices, KeepsTheNodeOfAComponentThatIsShutDown) {
  open_topics();
  Inbox<SamplePtr> events;
  const auto listener = bridge->open_reader(
      test::topic("/robot/echo/transition_event", "lifecycle_msgs/msg/TransitionEvent"), events.callback());
  ASSERT_TRUE(eventually([&] { return listener->matched_writers() == 1; }));
  // A match here does not imply a match there.
  ASSERT_TRUE(
      eventually([&] { return change_state("deactivate") && change_state("activate") && !events.items().empty(); }));
  EXPECT_TRUE(change_state("shutdown"));
  EXPECT_EQ(state(), "finalized");
  EXPECT_FALSE(change_state("activate"));
  EXPECT_TRUE(events.wait_for([](const SamplePtr& sample) {
    const auto event = Sample::as<lifecycle_msgs::msg::TransitionEvent>(sample);
    return event->start_state().label() == "shuttingdown" && event->goal_state().label() == "finalized";
  }));
  EXPECT_TRUE(eventually([&] { return writer->matched_readers() == 0; }));  // its inputs are closed
  EXPECT_THAT(set_before("new"), HasSubstr("shut down"));
  EXPECT_THAT(loaded(), testing::ElementsAre("/robot/echo"));
  const auto is_listed = [&] {
    const auto nodes = bridge->graph().nodes;
    return std::ranges::find(nodes, "echo", &GraphNode::name) != nodes.end();
  };
  EXPECT_TRUE(eventually(is_listed));
  EXPECT_TRUE(unload(1).success());
  EXPECT_TRUE(eventually([&] { return !is_listed(); }));
}

TEST_F(NodeServices, HasParametersInTheContainerToo) {
  rcl_interfaces::srv::ListParameters_Response listed = ask<rcl_interfaces::srv::ListParameters_Response>(
      "/controlled/list_parameters", "rcl_interfaces/srv/ListParameters",
      rcl_interfaces::srv::ListParameters_Request());
  EXPECT_THAT(listed.result().names(), testing::Contains("use_sim_time"));
  EXPECT_THAT(listed.result().names(), testing::Contains("qos_overrides./parameter_events.publisher.depth"));
  rcl_interfaces::srv::SetParameters_Request request;
  request.parameters().resize(1);
  request.parameters()[0].name("use_sim_time");
  request.parameters()[0].value().type(1);  // a bool
  request.parameters()[0].value().bool_value(true);
  const auto results = ask<rcl_interfaces::srv::SetParameters_Response>("/controlled/set_parameters",
                                                                        "rcl_interfaces/srv/SetParameters", request)
                           .results();
  EXPECT_TRUE(results.at(0).successful()) << results.at(0).reason();
}

TEST_F(NodeServices, TellsRos2WhichNodesThereAreAndWhatTheyHave) {
  open_topics();
  const auto node = [&](const std::string& name) {
    const auto nodes = bridge->graph().nodes;
    const auto found = std::ranges::find(nodes, name, &GraphNode::name);
    return found == nodes.end() ? GraphNode{} : *found;
  };
  // Services: the component's twelve, the container's ten. Topics: the component's two and its transitions, /rosout and
  // /parameter_events of both, the container's /diagnostics.
  EXPECT_TRUE(eventually([&] { return node("echo").readers.size() == 13 && node("echo").writers.size() == 16; }));
  EXPECT_TRUE(
      eventually([&] { return node("controlled").readers.size() == 10 && node("controlled").writers.size() == 13; }));
  EXPECT_EQ(node("echo").name_space, "/robot");
  const auto id = load(relay()).unique_id();
  EXPECT_TRUE(eventually([&] { return node("relay").name == "relay"; }));
  EXPECT_TRUE(unload(id).success());
  EXPECT_TRUE(eventually([&] { return node("relay").name.empty(); }));
}

TEST_F(NodeServices, HaveTheTypeHashOfRos2) {
  std::vector<std::string> hashes;
  ASSERT_TRUE(eventually([&] {
    hashes.clear();
    for (const auto& endpoint : bridge->graph().endpoints) {
      if (endpoint.name == "/robot/echo/get_parameters") hashes.push_back(endpoint.type_hash);
    }
    return hashes.size() == 2;  // requests and replies
  }));
  EXPECT_THAT(hashes, testing::Each("RIHS01_bf9803d5c74cf989a5de3e0c2e99444599a627c7ff75f97b8c05b01003675cbc"));
}

TEST_F(NodeServices, LosesNothingElsewhereAndKeepsNoMemoryWhileComponentsComeAndGo) {
  open_topics();
  constexpr std::size_t kCycles = 600, kMessagesEach = 10;
  std::size_t sent = 0;
  const auto send = [&] {
    for (std::size_t i = 0; i < kMessagesEach; ++i) ASSERT_TRUE(writer->write(text_sample(std::to_string(sent++))));
  };
  std::mt19937 random(7);
  // Names are reused, as users do: Fast DDS 2.9 keeps a few kilobytes for each topic name it has ever seen.
  std::map<std::string, std::uint64_t> there;
  std::size_t loads = 0, resident_kb = 0;
  while (loads < kCycles || !there.empty()) {
    ASSERT_NO_FATAL_FAILURE(send());
    auto request = relay();
    request.node_name("relay" + std::to_string(random() % 5));
    if (const auto one = there.find(request.node_name()); one != there.end()) {
      ASSERT_TRUE(unload(one->second).success());
      there.erase(one);
    } else if (loads < kCycles) {
      const auto response = load(request);
      ASSERT_TRUE(response.success()) << response.error_message();
      there[request.node_name()] = response.unique_id();
      // Caches and histories are full by then: of 1,200 loads, the first 300 add about 3 MB, all others 1 MB.
      if (++loads == kCycles / 2) resident_kb = peer.resident_kb();
    }
  }
  const auto items = echoed.wait_for_count(sent);
  ASSERT_EQ(items.size(), sent);
  for (std::size_t i = 0; i < sent; ++i) ASSERT_EQ(text_of(items[i]), std::to_string(i));
  EXPECT_THAT(loaded(), testing::ElementsAre("/robot/echo"));
  RecordProperty("resident_kb_halfway", static_cast<int>(resident_kb));
  RecordProperty("resident_kb_at_the_end", static_cast<int>(peer.resident_kb()));
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // which keep freed memory for a while
  EXPECT_LT(static_cast<double>(peer.resident_kb()), 1.05 * static_cast<double>(resident_kb));
#endif
}

}  // namespace
}  // namespace panvo::runtime::test
