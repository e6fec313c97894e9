// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnostic_msgs/msg/DiagnosticArray.h"
#include "panvo/interfaces/node_topics.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "rcl_interfaces/srv/ListParameters.h"
#include "web_view_fixture.hpp"

namespace panvo::web_view::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

struct Gain {
  double gain = 1;
  int count = 3;
  template <class Field>
  static void describe(Field&& field) {
    field(&Gain::gain, "gain", "1", "a gain", 0.0, 10.0);
    field(&Gain::count, "count", "", "a count", 0, 5);
  }
};

/// With a component that has parameters.
class WebViewNodes : public WebView {
 protected:
  void start_with_gain(const std::map<std::string, std::string>& parameters = {}) {
    start(parameters);
    container_->add(description("amplifier"), [](runtime::Context& context) {
      context.parameters<Gain>();
      context.on_parameters<Gain>([](const Gain&) {});
      return std::make_unique<runtime::Component>();
    });
  }

  static json get(WebSocketClient& client, const std::vector<std::string>& names) {
    client.send_text(json{{"op", "getParameters"}, {"parameterNames", names}, {"id", "get"}}.dump());
    return next_text(client, "parameterValues");
  }
  static void set(WebSocketClient& client, const json& parameter) {
    client.send_text(json{{"op", "setParameters"}, {"parameters", {parameter}}, {"id", "set"}}.dump());
  }
};

TEST_F(WebViewNodes, HaveParameters) {
  start_with_gain();
  WebSocketClient client(port());
  const json answer = get(client, {"/amplifier/gain", "/amplifier/none"});
  EXPECT_EQ(answer["id"], "get");
  EXPECT_EQ(answer["parameters"], json::parse(R"([{"name": "/amplifier/gain", "value": 1.0, "type": "float64"}])"));
  EXPECT_THAT(get(client, {})["parameters"], AllOf(Contains(json{{"name", "/amplifier/count"}, {"value", 3}}),
                                                   Contains(json{{"name", "/web_view/max_clients"}, {"value", 8}})));
  client.send_text(R"({"op":"getParameters","parameterNames":["/nobody/gain"]})");
  EXPECT_THAT(next_status(client), HasSubstr("/nobody/gain: there is no such node"));
}

TEST_F(WebViewNodes, KeepTheirParametersUnlessControlIsAllowed) {
  start_with_gain();
  WebSocketClient client(port());
  set(client, {{"name", "/amplifier/gain"}, {"value", 2}});
  EXPECT_THAT(next_status(client), HasSubstr("allow_control of the web view is false"));
  EXPECT_EQ(get(client, {"/amplifier/gain"})["parameters"][0]["value"], 1.0);
}

TEST_F(WebViewNodes, TakeParametersOfAClientThatMayControl) {
  start_with_gain({{"allow_control", "true"}});
  WebSocketClient client(port()), watcher(port());
  watcher.send_text(R"({"op":"subscribeParameterUpdates","parameterNames":["/amplifier/gain"]})");
  settle(watcher);
  set(client, {{"name", "/amplifier/gain"}, {"value", 2}});
  const json expected = json::parse(R"([{"name": "/amplifier/gain", "value": 2.0, "type": "float64"}])");
  EXPECT_EQ(next_text(client, "parameterValues")["parameters"], expected);
  EXPECT_EQ(next_text(watcher, "parameterValues")["parameters"], expected);
  set(client, {{"name", "/amplifier/gain"}, {"value", 20}});
  EXPECT_THAT(next_status(client), HasSubstr("/amplifier/gain was not set: "));
  EXPECT_EQ(next_text(client, "parameterValues")["parameters"], expected);
  // Unwatched: only the change of the other one is told of.
  watcher.send_text(R"({"op":"unsubscribeParameterUpdates","parameterNames":[]})");
  watcher.send_text(R"({"op":"subscribeParameterUpdates","parameterNames":["/amplifier/count"]})");
  settle(watcher);
  set(client, {{"name", "/amplifier/gain"}, {"value", 3}});
  set(client, {{"name", "/amplifier/count"}, {"value", 5}});
  EXPECT_EQ(next_text(watcher, "parameterValues")["parameters"],
            json::parse(R"([{"name": "/amplifier/count", "value": 5}])"));
}

TEST_F(WebViewNodes, DoNotChangeWhatIsFixedAfterConstruction) {
  start_with_gain({{"allow_control", "true"}});
  WebSocketClient client(port());
  set(client, {{"name", "/web_view/page"}, {"value", "/"}});
  EXPECT_THAT(next_status(client), HasSubstr("/web_view/page was not set: "));
}

std::vector<std::uint8_t> call_frame(std::uint32_t service, std::uint32_t call,
                                     const std::vector<std::uint8_t>& payload, const std::string& encoding = "cdr") {
  std::vector<std::uint8_t> frame{2};
  for (const std::uint32_t value : {service, call, static_cast<std::uint32_t>(encoding.size())}) {
    for (int i = 0; i < 4; ++i) frame.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  }
  frame.insert(frame.end(), encoding.begin(), encoding.end());
  frame.insert(frame.end(), payload.begin(), payload.end());
  return frame;
}

TEST_F(WebViewNodes, AnswerServiceCallsOfAClientThatMayControl) {
  start_with_gain({{"allow_control", "true"}});
  WebSocketClient client(port());
  const json services = next_text(client, "advertiseServices")["services"];
  const auto found =
      std::ranges::find_if(services, [](const json& one) { return one["name"] == "/amplifier/list_parameters"; });
  ASSERT_NE(found, services.end());
  EXPECT_EQ((*found)["type"], "rcl_interfaces/srv/ListParameters");
  const std::uint32_t id = (*found)["id"];
  const auto request = runtime::to_bytes(rcl_interfaces::srv::ListParameters_Request());
  client.send_binary(call_frame(id, 5, request));
  const auto frame = next_message(client);
  constexpr std::size_t kHead = 16;
  ASSERT_GT(frame.size(), kHead);
  EXPECT_EQ(frame[0], 3);
  const auto response =
      runtime::from_bytes<rcl_interfaces::srv::ListParameters_Response>({frame.begin() + kHead, frame.end()});
  EXPECT_THAT(response.result().names(), AllOf(Contains("gain"), Contains("count")));

  for (const auto& [bad, why] :
       std::map<std::vector<std::uint8_t>, std::string>{{call_frame(id, 6, {1, 2, 3}), ""},
                                                        {call_frame(id, 6, request, "json"), "the encoding is not cdr"},
                                                        {call_frame(4711, 6, request), "unknown service 4711"}}) {
    client.send_binary(bad);
    const json failure = next_text(client, "serviceCallFailure");
    EXPECT_EQ(failure["callId"], 6);
    EXPECT_THAT(failure["message"].get<std::string>(), AllOf(HasSubstr(why), Not(IsEmpty())));
  }
}

TEST_F(WebViewNodes, AnswerNoServiceCallUnlessControlIsAllowed) {
  start_with_gain();
  WebSocketClient client(port());
  client.send_binary(call_frame(1, 6, {0, 1, 0, 0}));
  EXPECT_THAT(next_text(client, "serviceCallFailure")["message"].get<std::string>(), HasSubstr("allow_control"));
}

TEST_F(WebViewNodes, AreConnectedByTopicsAndServices) {
  start_with_gain();
  WebSocketClient client(port());
  client.send_text(R"({"op":"subscribeConnectionGraph"})");
  const json graph = next_text(client, "connectionGraphUpdate");
  EXPECT_THAT(graph["publishedTopics"], Contains(json{{"name", "/odometry/binocular"}, {"publisherIds", {"/camera"}}}));
  EXPECT_THAT(graph["subscribedTopics"], Contains(json{{"name", "/initialpose"}, {"subscriberIds", {"/listener"}}}));
  EXPECT_THAT(graph["advertisedServices"],
              Contains(json{{"name", "/amplifier/get_parameters"}, {"providerIds", {"/amplifier"}}}));
  container_->unload("amplifier");
  EXPECT_THAT(next_text(client, "connectionGraphUpdate")["removedServices"], Contains("/amplifier/get_parameters"));
}

TEST_F(WebViewNodes, GiveAssetsOfTheConfiguredFolder) {
  const panvo::test::TemporaryFolder folder;
  folder.write("rig/camera.stl", "mesh");
  start({{"assets", folder.path().string()}});
  WebSocketClient client(port());
  EXPECT_THAT(next_text(client, "serverInfo")["capabilities"], Contains("assets"));
  client.send_text(R"({"op":"fetchAsset","uri":"package://rig/camera.stl","requestId":7})");
  EXPECT_THAT(next_message(client), ElementsAre(4, 7, 0, 0, 0, 0, 0, 0, 0, 0, 'm', 'e', 's', 'h'));
  client.send_text(R"({"op":"fetchAsset","uri":"package://rig/../camera.stl","requestId":8})");
  const auto failure = next_message(client);
  EXPECT_THAT(std::vector<std::uint8_t>(failure.begin(), failure.begin() + 6), ElementsAre(4, 8, 0, 0, 0, 1));
}

TEST_F(WebViewNodes, TellTheTimeOfASimulation) {
  start();
  std::optional<runtime::Output<rosgraph_msgs::msg::Clock>> clock;
  container_->add(description("simulation"), [&](runtime::Context& context) {
    clock.emplace(context.output(topics::kClock));
    return std::make_unique<runtime::Component>();
  });
  WebSocketClient early(port());  // from now on the clock is read
  const json untimed = next_text(early, "serverInfo");
  EXPECT_THAT(untimed["capabilities"], Not(Contains("time")));
  next_text(early, "advertise");
  rosgraph_msgs::msg::Clock now;
  now.clock().sec(1);
  clock->publish(now);
  WebSocketClient client(port());
  const json timed = next_text(client, "serverInfo");
  EXPECT_THAT(timed["capabilities"], Contains("time"));
  const std::vector<std::uint8_t> second{0x00, 0xca, 0x9a, 0x3b, 0, 0, 0, 0};  // 1e9 ns
  auto frame = next_message(client);
  EXPECT_EQ(frame[0], 2);
  EXPECT_EQ(std::vector<std::uint8_t>(frame.begin() + 1, frame.end()), second);
  // The session of an earlier client is restarted with the time.
  EXPECT_EQ(next_text(early, "serverInfo"), timed);
  EXPECT_NE(timed["sessionId"], untimed["sessionId"]);
  EXPECT_EQ(next_text(early, "advertise")["channels"], json::array());
  EXPECT_EQ(next_message(early), frame);
  // Messages have the same clock.
  subscribe(client, 7, channel_of(client, "/odometry/binocular"));
  settle(client);
  odometry_->publish(odometry(12));
  frame = next_message(client);
  ASSERT_GT(frame.size(), 13u);
  EXPECT_EQ(std::vector<std::uint8_t>(frame.begin() + 5, frame.begin() + 13), second);
  clock.reset();
}

TEST_F(WebViewNodes, LearnOfTheClientsFromDiagnostics) {
  start();
  WebSocketClient client(port());
  subscribe(client, 1, channel_of(client, "/diagnostics"));
  std::map<std::string, std::string> values;
  while (!values.contains("clients")) {
    const auto frame = next_message(client);
    constexpr std::size_t kHead = 13;
    ASSERT_GT(frame.size(), kHead);
    const auto array = runtime::from_bytes<diagnostic_msgs::msg::DiagnosticArray>({frame.begin() + kHead, frame.end()});
    for (const auto& status : array.status()) {
      for (const auto& value : status.values()) {
        if (status.name() == "panvo: web_view") values[value.key()] = value.value();
      }
    }
  }
  EXPECT_EQ(values["clients"], "1 now, 0 before, 0 messages dropped");
  EXPECT_THAT(values, Contains(::testing::Pair(HasSubstr("client 127.0.0.1:"), "1 subscriptions, 0 messages dropped")));
}

TEST_F(WebViewNodes, AreNotShownToPagesOfOtherSites) {
  start({{"allowed_origins", "[https://viewer.example.org]"}});
  const auto status = [&](const std::string& origin) {
    const std::string headers = "Sec-WebSocket-Protocol: foxglove.sdk.v1\r\nOrigin: " + origin + "\r\n";
    return WebSocketClient(port(), {.path = "/", .headers = headers}).status();
  };
  EXPECT_EQ(status("https://example.org"), 403);
  EXPECT_EQ(status("null"), 403);
  EXPECT_EQ(status("http://localhost:" + std::to_string(port())), 101);
  EXPECT_EQ(status("https://app.foxglove.dev"), 101);
  EXPECT_EQ(status("https://viewer.example.org"), 101);
}

TEST_F(WebViewNodes, AreShownToAnySiteWithTheToken) {
  start({{"token", "sesame"}});
  const std::string headers = "Sec-WebSocket-Protocol: foxglove.sdk.v1\r\nOrigin: https://example.org\r\n";
  EXPECT_EQ(WebSocketClient(port(), {.path = "/?token=sesame", .headers = headers}).status(), 101);
}

}  // namespace
}  // namespace panvo::web_view::test
