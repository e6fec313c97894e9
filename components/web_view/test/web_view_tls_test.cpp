// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include "panvo/runtime/errors.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "tls_client.hpp"
#include "web_view_fixture.hpp"

namespace panvo::web_view::test {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class WebViewTls : public WebView {
 protected:
  void start_tls(std::map<std::string, std::string> parameters = {}) {
    folder_.write("page/index.html", "<p>hello");
    const auto files = make_certificate(folder_.path(), "vehicle");
    parameters.emplace("tls_certificate", files.certificate.string());
    parameters.emplace("tls_key", files.key.string());
    parameters.emplace("page", (folder_ / "page").string());
    start(parameters);
  }
  std::string get(const std::string& path) {
    return http_answer(port(), "GET " + path + " HTTP/1.1\r\nHost: localhost\r\n\r\n", tls_stream);
  }
  int socket_status(const std::string& path) {
    return WebSocketClient(port(), {.path = path, .connect = tls_stream}).status();
  }
  /// The port on which civetweb listens behind TLS.
  int inner_port() {
    for (int number = 0; number < 1000; ++number) {
      int is_listening = 0;
      socklen_t size = sizeof is_listening;
      if (::getsockopt(number, SOL_SOCKET, SO_ACCEPTCONN, &is_listening, &size) != 0 || is_listening == 0) continue;
      if (port_of(number) != port()) return port_of(number);
    }
    return 0;
  }

  const panvo::test::TemporaryFolder folder_;
};

TEST_F(WebViewTls, ServesPageAndMessages) {
  start_tls();
  EXPECT_TRUE(is_logged("listening on wss://127.0.0.1:"));
  EXPECT_THAT(get("/"), AllOf(StartsWith("HTTP/1.1 200 OK\r\n"), EndsWith("\r\n\r\n<p>hello")));
  WebSocketClient client(port(), {.connect = tls_stream});
  subscribe(client, 77, channel_of(client, "/odometry/binocular"));
  settle(client);
  odometry_->publish(odometry(12));
  EXPECT_EQ(decoded(next_message(client)), odometry(12));
}

TEST_F(WebViewTls, CarriesLargeMessages) {
  start_tls();
  WebSocketClient client(port(), {.connect = tls_stream});
  subscribe(client, 1, channel_of(client, "/panorama/image"));
  settle(client);
  sensor_msgs::msg::Image image;
  image.encoding("mono8");
  image.width(1000);
  image.height(3000);
  image.step(1000);
  image.data().resize(3'000'000);
  for (std::size_t i = 0; i < image.data().size(); ++i) image.data()[i] = static_cast<std::uint8_t>(i * i / 7);
  images_->publish(image);
  const auto frame = next_message(client);
  ASSERT_GT(frame.size(), image.data().size());
  EXPECT_EQ(runtime::from_bytes<sensor_msgs::msg::Image>({frame.begin() + 13, frame.end()}), image);
}

TEST_F(WebViewTls, AsksForItsToken) {
  start_tls({{"token", "sesame"}});
  EXPECT_EQ(socket_status("/"), 401);
  EXPECT_EQ(socket_status("/?token=sesam"), 401);
  EXPECT_EQ(socket_status("/?token=sesame"), 101);
  EXPECT_THAT(get("/"), StartsWith("HTTP/1.1 401 "));
  EXPECT_THAT(get("/?token=sesame"), AllOf(StartsWith("HTTP/1.1 200 "), HasSubstr("; SameSite=Strict; Secure\r\n")));
}

TEST_F(WebViewTls, RefusesOtherOriginsAndTooManyClients) {
  start_tls({{"max_clients", "1"}});
  const std::string headers = "Sec-WebSocket-Protocol: foxglove.sdk.v1\r\nOrigin: https://example.org\r\n";
  EXPECT_EQ(WebSocketClient(port(), {.headers = headers, .connect = tls_stream}).status(), 403);
  WebSocketClient client(port(), {.connect = tls_stream});
  next_text(client, "serverInfo");
  EXPECT_EQ(socket_status("/"), 503);
}

TEST_F(WebViewTls, KnowsTheClientBehindTheRelay) {
  start_tls({{"allow_control", "true"}});
  WebSocketClient client(port(), {.connect = tls_stream});
  client.send_text(R"({"op":"advertise","channels":[{"id":3,"topic":"/initialpose","encoding":"cdr",
                       "schemaName":"geometry_msgs/msg/PoseWithCovarianceStamped"}]})");
  EXPECT_TRUE(is_logged("client 127.0.0.1:" + std::to_string(client.own_port()) + " publishes /initialpose"));
}

TEST_F(WebViewTls, LetsNobodyInWhoGoesRoundIt) {
  start_tls();
  const int inner = inner_port();
  ASSERT_NE(inner, 0);
  EXPECT_EQ(WebSocketClient(inner).status(), 403);
  EXPECT_THAT(http_answer(inner, "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"), StartsWith("HTTP/1.1 403 "));
}

TEST_F(WebViewTls, ClosesAClientThatDoesNotReadAndServesTheOthers) {
  start_tls({{"queue_mb", "1"}});
  WebSocketClient stuck(port(), {.receive_buffer = 4096, .connect = tls_stream});
  WebSocketClient reading(port(), {.connect = tls_stream});
  subscribe(stuck, 1, channel_of(stuck, "/odometry/binocular"));
  settle(stuck);
  subscribe(reading, 1, channel_of(reading, "/odometry/binocular"));
  settle(reading);
  for (int i = 0; i < 20'000; ++i) {  // more than sockets, relay and queue hold
    odometry_->publish(odometry(i));
    ASSERT_EQ(decoded(next_message(reading)).header().stamp().sec(), i);
  }
  EXPECT_TRUE(is_logged("does not read what it subscribed to: closed"));
}

TEST_F(WebViewTls, EndsWithClientsInEveryState) {
  start_tls();
  const auto stalled = plain_stream(port(), 0);
  const TlsStream silent(port());
  WebSocketClient client(port(), {.connect = tls_stream});
  settle(client);
  TearDown();
  EXPECT_FALSE(client.receive());
}

TEST_F(WebViewTls, IsRefusedWithTheKeyOfAnotherCertificate) {
  const auto files = make_certificate(folder_.path(), "vehicle"), other = make_certificate(folder_.path(), "other");
  try {
    start({{"tls_certificate", files.certificate.string()}, {"tls_key", other.key.string()}});
    FAIL() << "it was accepted";
  } catch (const runtime::ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("web_view: tls_key " + other.key.string() + ": is not the key of "));
  }
}

}  // namespace
}  // namespace panvo::web_view::test
