// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "panvo/runtime/errors.hpp"
#include "web_view_fixture.hpp"

namespace panvo::web_view::test {
namespace {

using ::testing::HasSubstr;

sensor_msgs::msg::Image image() {
  sensor_msgs::msg::Image message;
  message.encoding("mono8");
  message.width(1000);
  message.height(2000);
  message.step(1000);
  message.data().resize(2'000'000);
  return message;
}

TEST_F(WebView, OutlivesClientsThatSendRubbishAndVanish) {
  start();
  std::uint32_t random = 1;
  for (int i = 0; i < 500; ++i) {
    WebSocketClient client(port());
    std::vector<std::uint8_t> rubbish(200);
    for (auto& byte : rubbish) byte = static_cast<std::uint8_t>((random = random * 1'664'525 + 1'013'904'223) >> 24);
    if (i % 2 == 0) client.send_text({reinterpret_cast<const char*>(rubbish.data()), rubbish.size()});
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
  bool is_told = false;
  for (int next = 0; next < kCount || !is_told;) {
    const auto next_frame = client.receive();
    ASSERT_TRUE(next_frame);
    const auto& frame = next_frame->data;
    if (next_frame->operation == 1) {
      is_told = is_told || next_frame->text().find("large messages were left out") != std::string::npos;
      continue;
    }
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
}  // namespace panvo::web_view::test
