// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "panvo/compressed_images/decode.hpp"
#include "sensor_msgs/msg/CompressedImage.h"
#include "web_view_fixture.hpp"

namespace panvo::web_view::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

TEST_F(WebView, PresentsItselfUnderBothNamesOfTheProtocol) {
  start();
  for (const std::string name : {"foxglove.sdk.v1", "foxglove.websocket.v1"}) {
    WebSocketClient client(port(), {.path = "/", .headers = "Sec-WebSocket-Protocol: other, " + name + "\r\n"});
    ASSERT_EQ(client.status(), 101);
    EXPECT_THAT(client.answer(), HasSubstr("Sec-WebSocket-Protocol: " + name + "\r\n"));
    const json info = next_text(client, "serverInfo");
    EXPECT_EQ(info["name"], "panvo");
    EXPECT_EQ(info["capabilities"], json::array({"parameters", "parametersSubscribe", "connectionGraph"}));
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
  EXPECT_THAT(std::vector<std::uint8_t>(frame.begin(), frame.begin() + 5), ::testing::ElementsAre(1, 77, 0, 0, 0));
}

TEST_F(WebView, DescribesTypesInOmgIdlToClientsThatAskForIt) {
  start();
  WebSocketClient client(port(), {.path = "/?schemas=omgidl"}), other(port());
  for (auto* one : {&client, &other}) {
    const json channels = next_text(*one, "advertise")["channels"];
    const auto found =
        std::ranges::find_if(channels, [](const json& channel) { return channel["topic"] == "/odometry/binocular"; });
    ASSERT_NE(found, channels.end());
    EXPECT_EQ((*found)["schemaEncoding"], one == &client ? "omgidl" : "ros2msg");
    EXPECT_EQ((*found)["schemaName"], one == &client ? "nav_msgs::msg::Odometry" : "nav_msgs/msg/Odometry");
  }
}

TEST_F(WebView, OffersRawImagesCompressedToo) {
  start();
  WebSocketClient client(port()), other(port());
  const auto channel = channel_of(client, "/panorama/image/compressed");
  subscribe(client, 3, channel);
  subscribe(other, 4, channel_of(other, "/panorama/image/compressed"));
  settle(client);
  settle(other);
  sensor_msgs::msg::Image image;
  image.header().stamp().sec(5);
  image.width(320);
  image.height(160);
  image.step(320);
  image.encoding("mono8");
  image.data().assign(std::size_t{320} * 160, 90);
  images_->publish(image);
  for (auto* one : {&client, &other}) {
    const auto frame = next_message(*one);
    ASSERT_GT(frame.size(), 13U);
    const auto compressed = runtime::from_bytes<sensor_msgs::msg::CompressedImage>({frame.begin() + 13, frame.end()});
    EXPECT_EQ(compressed.header().stamp().sec(), 5);
    EXPECT_EQ(compressed.format(), "mono8; jpeg compressed ");
    EXPECT_LT(compressed.data().size(), image.data().size() / 10);
    const auto decoded = compressed_images::decode(compressed, compressed_images::Output::kSame);
    ASSERT_TRUE(decoded) << decoded.reason();
    EXPECT_EQ((*decoded)->width(), 320U);
    EXPECT_NEAR((*decoded)->data()[1000], 90, 2);
  }
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
  subscribe(client, 3, channel);
  settle(client);
  container_->unload("late");
  EXPECT_THAT(next_text(client, "unadvertise")["channelIds"], Contains(channel));
  const std::string unsubscribe = R"({"op":"unsubscribe","subscriptionIds":[3]})";
  client.send_text(unsubscribe);  // has already ended
  settle(client);
  client.send_text(unsubscribe);
  EXPECT_EQ(next_status(client), "unknown subscription 3");
  subscribe(client, 1, channel);
  EXPECT_EQ(next_status(client), "subscription 1: unknown channel " + std::to_string(channel));
}

TEST_F(WebView, AnswersRubbishWithAStatus) {
  start();
  WebSocketClient client(port());
  client.send_text("{");
  EXPECT_EQ(next_status(client), "a text message is not JSON");
  client.send_binary(std::vector<std::uint8_t>{99});
  EXPECT_EQ(next_status(client), "binary operation 99 is not supported");
  subscribe(client, 1, 4711);
  EXPECT_EQ(next_status(client), "subscription 1: unknown channel 4711");
  client.send_text(R"({"op":"unsubscribe","subscriptionIds":[5]})");
  EXPECT_EQ(next_status(client), "unknown subscription 5");
  client.send_binary(std::vector<std::uint8_t>(4'000'001));
  EXPECT_EQ(next_status(client), "a message is larger than 4000000 bytes");
  settle(client);
}

std::vector<std::uint8_t> u32(std::uint32_t value) {
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  return bytes;
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
  EXPECT_THAT(next_text(client, "serverInfo")["capabilities"], Contains("clientPublish"));
  client.send_text(kAdvertisePose);
  client.send_binary(pose_frame());
  EXPECT_TRUE(is_logged("pose in map"));
  client.send_binary(std::vector<std::uint8_t>{1, 3, 0, 0, 0, 0, 1, 0, 0, 9});
  EXPECT_NE(next_status(client), "no status");
  client.send_binary(std::vector<std::uint8_t>{1, 4, 0, 0, 0, 0, 1, 0, 0, 9});
  EXPECT_EQ(next_status(client), "channel 4 is not advertised by this client");
}

}  // namespace
}  // namespace panvo::web_view::test
