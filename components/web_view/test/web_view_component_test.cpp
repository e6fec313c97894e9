// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <condition_variable>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "geometry_msgs/msg/PoseWithCovarianceStamped.h"
#include "nav_msgs/msg/Odometry.h"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/container.hpp"
#include "panvo/runtime/errors.hpp"
#include "sensor_msgs/msg/Image.h"
#include "web_socket_client.hpp"

namespace panvo::web_view {
namespace {

using nlohmann::json;
using test::WebSocketClient;
using testing::HasSubstr;

runtime::ComponentDescription description(const std::string& name,
                                          const std::map<std::string, std::string>& parameters = {}) {
  runtime::ComponentDescription description;
  description.name = name;
  description.name_space = "/";
  for (const auto& [key, text] : parameters)
    description.parameters[key] = runtime::WrittenValue{.items = {text}, .is_list = false, .where = {"test", 0}};
  return description;
}

nav_msgs::msg::Odometry odometry(std::int32_t sec) {
  nav_msgs::msg::Odometry message;
  message.header().stamp().sec(sec);
  message.header().frame_id("odom");
  message.pose().pose().position().x(1.5);
  return message;
}

sensor_msgs::msg::Image image() {
  sensor_msgs::msg::Image message;
  message.encoding("mono8");
  message.width(1000);
  message.height(2000);
  message.step(1000);
  message.data().resize(2'000'000);
  return message;
}

std::vector<std::uint8_t> u32(std::uint32_t value) {
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  return bytes;
}

/// A web view in a live container without DDS, which also publishes odometry and images.
class WebView : public testing::Test {
 protected:
  void start(std::map<std::string, std::string> parameters = {}) {
    container_.emplace(runtime::ContainerOptions{
        .log = [this](runtime::LogLevel, const std::string&, const std::string& text) { take_log(text); }});
    container_->add(description("camera"), [this](runtime::Context& context) {
      odometry_.emplace(context.output(topics::kOdometryBinocular));
      images_.emplace(context.output(topics::kPanorama));
      return std::make_unique<runtime::Component>();
    });
    container_->add(description("listener"), [this](runtime::Context& context) {
      context.input(topics::kInitialPose,
                    [this](const std::shared_ptr<const geometry_msgs::msg::PoseWithCovarianceStamped>& pose) {
                      take_log("pose in " + pose->header().frame_id());
                    });
      return std::make_unique<runtime::Component>();
    });
    parameters.emplace("port", "0");
    auto view = description("web_view", parameters);
    view.package = "panvo_web_view";
    view.plugin = "WebViewComponent";
    container_->load(view);
    container_->start();
  }

  void TearDown() override {
    odometry_.reset();
    images_.reset();
    container_.reset();
  }

  void take_log(const std::string& text) {
    {
      const std::lock_guard lock(mutex_);
      log_ += text + "\n";
    }
    logged_.notify_all();
  }
  [[nodiscard]] bool is_logged(const std::string& text) {
    std::unique_lock lock(mutex_);
    return logged_.wait_for(lock, std::chrono::seconds(30), [&] { return log_.find(text) != std::string::npos; });
  }

  int port() {
    const std::string start = "listening on ws://127.0.0.1:";
    EXPECT_TRUE(is_logged(start));
    const std::lock_guard lock(mutex_);
    return std::stoi(log_.substr(log_.find(start) + start.size()));
  }

  /// Next text of this operation; others are skipped.
  static json next_text(WebSocketClient& client, const std::string& operation) {
    while (const auto frame = client.receive()) {
      if (frame->operation != 1) continue;
      auto object = json::parse(frame->text());
      if (object["op"] == operation) return object;
    }
    return {};
  }
  static std::string next_status(WebSocketClient& client) {
    return next_text(client, "status").value("message", "no status");
  }
  /// Id of a topic's channel according to the next list of channels.
  static std::uint32_t channel_of(WebSocketClient& client, const std::string& topic) {
    const json channels = next_text(client, "advertise")["channels"];
    for (const auto& channel : channels) {
      if (channel["topic"] == topic) return channel["id"];
    }
    ADD_FAILURE() << topic << " is not offered";
    return 0;
  }
  static void subscribe(WebSocketClient& client, std::uint32_t id, std::uint32_t channel) {
    client.send_text(json{{"op", "subscribe"}, {"subscriptions", {{{"id", id}, {"channelId", channel}}}}}.dump());
  }
  /// Returns once the server has handled what was sent before.
  static void settle(WebSocketClient& client) {
    client.send_text(R"({"op":"settle"})");
    EXPECT_EQ(next_status(client), "operation settle is not supported");
  }
  /// The next message of any subscription.
  static std::vector<std::uint8_t> next_message(WebSocketClient& client) {
    while (auto frame = client.receive()) {
      if (frame->operation == 2) return std::move(frame->data);
    }
    return {};
  }
  static nav_msgs::msg::Odometry decoded(const std::vector<std::uint8_t>& frame) {
    constexpr std::size_t kHead = 13;
    if (frame.size() < kHead) throw std::runtime_error("no message came");
    return runtime::from_bytes<nav_msgs::msg::Odometry>({frame.begin() + kHead, frame.end()});
  }

  std::mutex mutex_;
  std::condition_variable logged_;
  std::string log_;
  std::optional<runtime::Output<nav_msgs::msg::Odometry>> odometry_;
  std::optional<runtime::Output<sensor_msgs::msg::Image>> images_;
  std::optional<runtime::Container> container_;
};

TEST_F(WebView, PresentsItselfUnderBothNamesOfTheProtocol) {
  start();
  for (const std::string name : {"foxglove.sdk.v1", "foxglove.websocket.v1"}) {
    WebSocketClient client(port(), {.path = "/", .headers = "Sec-WebSocket-Protocol: other, " + name + "\r\n"});
    ASSERT_EQ(client.status(), 101);
    EXPECT_THAT(client.answer(), HasSubstr("Sec-WebSocket-Protocol: " + name + "\r\n"));
    const json info = next_text(client, "serverInfo");
    EXPECT_EQ(info["name"], "panvo");
    EXPECT_EQ(info["capabilities"], json::array());
  }
  // Often enough that every thread of the server gets one that asks and one that does not.
  for (int i = 0; i < 30; ++i) {
    EXPECT_EQ(WebSocketClient(port(), {.path = "/", .headers = ""}).status(), 400);
    EXPECT_EQ(WebSocketClient(port(), {.path = "/", .headers = "Sec-WebSocket-Protocol: other\r\n"}).status(), 400);
    EXPECT_NE(WebSocketClient(port()).status(), 400);
  }
}

TEST_F(WebView, SendsWhatAClientSubscribesTo) {
  start();
  WebSocketClient client(port());
  const json channels = next_text(client, "advertise")["channels"];
  const auto found =
      std::ranges::find_if(channels, [](const json& one) { return one["topic"] == "/odometry/binocular"; });
  ASSERT_NE(found, channels.end());
  EXPECT_EQ((*found)["schemaName"], "nav_msgs/msg/Odometry");
  EXPECT_EQ((*found)["schemaEncoding"], "ros2msg");
  EXPECT_EQ((*found)["schema"], interfaces::message_type<nav_msgs::msg::Odometry>().definition);
  subscribe(client, 77, (*found)["id"]);
  settle(client);
  odometry_->publish(odometry(12));
  const auto frame = next_message(client);
  EXPECT_EQ(decoded(frame), odometry(12));
  EXPECT_THAT(std::vector<std::uint8_t>(frame.begin(), frame.begin() + 5), testing::ElementsAre(1, 77, 0, 0, 0));
}

TEST_F(WebView, SendsNothingAfterTheClientUnsubscribed) {
  start();
  WebSocketClient client(port());
  const auto channel = channel_of(client, "/odometry/binocular");
  subscribe(client, 1, channel);
  client.send_text(R"({"op":"unsubscribe","subscriptionIds":[1]})");
  settle(client);
  odometry_->publish(odometry(1));
  subscribe(client, 2, channel);
  settle(client);
  odometry_->publish(odometry(2));
  EXPECT_EQ(decoded(next_message(client)), odometry(2));
}

TEST_F(WebView, TellsOfTopicsThatComeAndGo) {
  start();
  WebSocketClient client(port());
  channel_of(client, "/odometry/binocular");
  container_->add(description("late"), [](runtime::Context& context) {
    class Late final : public runtime::Component {
     public:
      explicit Late(runtime::Context& its_context) : output_(its_context.output(topics::kOdometryEnhanced)) {}

     private:
      runtime::Output<nav_msgs::msg::Odometry> output_;
    };
    return std::make_unique<Late>(context);
  });
  const auto channel = channel_of(client, "/odometry/enhanced");
  container_->unload("late");
  EXPECT_EQ(next_text(client, "unadvertise")["channelIds"], json::array({channel}));
  subscribe(client, 1, channel);
  EXPECT_EQ(next_status(client), "subscription 1: there is no channel " + std::to_string(channel));
}

TEST_F(WebView, AnswersRubbishWithAStatus) {
  start();
  WebSocketClient client(port());
  client.send_text("{");
  EXPECT_EQ(next_status(client), "a text message is not JSON");
  client.send_binary(std::vector<std::uint8_t>{99});
  EXPECT_EQ(next_status(client), "binary operation 99 is not supported");
  subscribe(client, 1, 4711);
  EXPECT_EQ(next_status(client), "subscription 1: there is no channel 4711");
  client.send_text(R"({"op":"unsubscribe","subscriptionIds":[5]})");
  EXPECT_EQ(next_status(client), "there is no subscription 5");
  client.send_binary(std::vector<std::uint8_t>(4'000'001));
  EXPECT_EQ(next_status(client), "a message is larger than 4000000 bytes");
  settle(client);
}

TEST_F(WebView, OutlivesClientsThatSendRubbishAndVanish) {
  start();
  std::uint32_t random = 1;
  for (int i = 0; i < 50; ++i) {
    WebSocketClient client(port());
    std::vector<std::uint8_t> rubbish(200);
    for (auto& byte : rubbish) byte = static_cast<std::uint8_t>((random = random * 1'664'525 + 1'013'904'223) >> 24);
    client.send_raw(rubbish);
  }
  for (bool is_in = false; !is_in;) {  // until the threads of those that vanished have noticed
    WebSocketClient client(port());
    is_in = client.status() == 101;
    if (is_in) {
      settle(client);
    } else {
      EXPECT_EQ(client.status(), 503);
    }
  }
}

TEST_F(WebView, AsksForItsToken) {
  start({{"token", "sesame"}});
  EXPECT_EQ(WebSocketClient(port()).status(), 401);
  EXPECT_EQ(WebSocketClient(port(), {.path = "/?token=sesam"}).status(), 401);
  EXPECT_EQ(WebSocketClient(port(), {.path = "/?token=sesame"}).status(), 101);
  const std::string header = "Sec-WebSocket-Protocol: foxglove.sdk.v1\r\nAuthorization: Bearer sesame\r\n";
  EXPECT_EQ(WebSocketClient(port(), {.path = "/", .headers = header}).status(), 101);
}

TEST_F(WebView, IsRefusedOnOtherAddressesWithoutAToken) {
  EXPECT_THROW(start({{"host", "0.0.0.0"}}), runtime::ConfigError);
}

TEST_F(WebView, IsRefusedOnAPortInUse) {
  start();
  auto second = description("second", {{"port", std::to_string(port())}});
  second.package = "panvo_web_view";
  second.plugin = "WebViewComponent";
  try {
    container_->load(second);
    FAIL() << "a second server on the same port";
  } catch (const runtime::ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("cannot listen on 127.0.0.1:"));
  }
}

TEST_F(WebView, LetsInNoMoreThanTheMostClients) {
  start({{"max_clients", "1"}});
  WebSocketClient client(port());
  next_text(client, "serverInfo");
  EXPECT_EQ(WebSocketClient(port()).status(), 503);
}

constexpr const char* kAdvertisePose =
    R"({"op":"advertise","channels":[{"id":3,"topic":"/initialpose","encoding":"cdr",
        "schemaName":"geometry_msgs/msg/PoseWithCovarianceStamped"}]})";

std::vector<std::uint8_t> pose_frame() {
  geometry_msgs::msg::PoseWithCovarianceStamped pose;
  pose.header().frame_id("map");
  pose.pose().pose().orientation().w(1);
  for (std::size_t i = 0; i < 36; i += 7) pose.pose().covariance()[i] = 1;
  std::vector<std::uint8_t> frame{1};
  for (const auto& part : {u32(3), runtime::to_bytes(pose)}) frame.insert(frame.end(), part.begin(), part.end());
  return frame;
}

TEST_F(WebView, RefusesControlUnlessAllowed) {
  start();
  WebSocketClient client(port());
  client.send_text(kAdvertisePose);
  EXPECT_THAT(next_status(client), HasSubstr("allow_control of the web view is false"));
  client.send_binary(pose_frame());
  EXPECT_THAT(next_status(client), HasSubstr("allow_control of the web view is false"));
}

TEST_F(WebView, PublishesForAClientThatMayControl) {
  start({{"allow_control", "true"}});
  WebSocketClient client(port());
  EXPECT_EQ(next_text(client, "serverInfo")["capabilities"], json::array({"clientPublish"}));
  client.send_text(kAdvertisePose);
  client.send_binary(pose_frame());
  EXPECT_TRUE(is_logged("pose in map"));
  client.send_binary(std::vector<std::uint8_t>{1, 3, 0, 0, 0, 0, 1, 0, 0, 9});
  EXPECT_NE(next_status(client), "no status");
  client.send_binary(std::vector<std::uint8_t>{1, 4, 0, 0, 0, 0, 1, 0, 0, 9});
  EXPECT_EQ(next_status(client), "there is no channel 4 of this client");
}

TEST_F(WebView, ClosesAClientThatDoesNotReadAndServesTheOthers) {
  start({{"queue_mb", "1"}});
  WebSocketClient stuck(port(), {.receive_buffer = 4096}), reading(port());
  const auto channel = channel_of(stuck, "/odometry/binocular");
  subscribe(stuck, 1, channel);
  settle(stuck);
  subscribe(reading, 1, channel_of(reading, "/odometry/binocular"));
  settle(reading);
  // More than the sockets and the queue hold, while the other client gets every message in turn.
  for (int i = 0; i < 20'000; ++i) {
    odometry_->publish(odometry(i));
    ASSERT_EQ(decoded(next_message(reading)).header().stamp().sec(), i);
  }
  EXPECT_TRUE(is_logged("does not read what it subscribed to: closed"));
}

TEST_F(WebView, DropsImagesForASlowClientAndNoPoses) {
  start();
  WebSocketClient client(port(), {.receive_buffer = 4096});
  const json channels = next_text(client, "advertise")["channels"];
  for (const auto& channel : channels) {
    if (channel["topic"] == "/panorama/image") subscribe(client, 1, channel["id"]);
    if (channel["topic"] == "/odometry/binocular") subscribe(client, 2, channel["id"]);
  }
  settle(client);
  constexpr int kCount = 40;  // images of 2 MB: more than queue and sockets hold
  for (int i = 0; i < kCount; ++i) {
    images_->publish(image());
    odometry_->publish(odometry(i));
  }
  int images = 0;
  for (int next = 0; next < kCount;) {
    const auto frame = next_message(client);
    ASSERT_GT(frame.size(), 13u);
    if (frame[1] == 1) {
      ++images;
    } else {
      EXPECT_EQ(decoded(frame).header().stamp().sec(), next++);
    }
  }
  EXPECT_LT(images, kCount / 2);
}

}  // namespace
}  // namespace panvo::web_view
