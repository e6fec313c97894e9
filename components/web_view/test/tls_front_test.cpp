// SPDX-License-Identifier: Apache-2.0
#include "tls_front.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <vector>

#include "descriptor.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "tls_client.hpp"

namespace panvo::web_view {
namespace {

using test::make_certificate;
using test::plain_stream;
using test::TlsStream;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// A front, and the plain server behind it, which the test plays itself.
class TlsFrontTest : public ::testing::Test {
 protected:
  TlsFrontTest() : listener_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in name{};
    name.sin_family = AF_INET;
    name.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::bind(listener_.get(), reinterpret_cast<const sockaddr*>(&name), sizeof name);
    ::listen(listener_.get(), 20);
    files_ = make_certificate(folder_.path(), "vehicle");
  }

  void start(TlsFront::Settings settings = {}) {
    settings.files = {files_.certificate, files_.key};
    settings.inner_port = test::port_of(listener_.get());
    front_.emplace(settings, peers_, [this](const std::string&, const std::string& text) {
      const std::lock_guard lock(mutex_);
      warnings_ += text + "\n";
      warned_.notify_all();
    });
  }
  [[nodiscard]] bool is_warned(const std::string& text) {
    std::unique_lock lock(mutex_);
    return warned_.wait_for(lock, std::chrono::seconds(20), [&] { return warnings_.find(text) != std::string::npos; });
  }

  /// The next connection of the front to the server.
  Descriptor accepted() const { return Descriptor(::accept(listener_.get(), nullptr, nullptr)); }
  static int peer_port(const Descriptor& connection) {
    sockaddr_in name{};
    socklen_t size = sizeof name;
    ::getpeername(connection.get(), reinterpret_cast<sockaddr*>(&name), &size);
    return ntohs(name.sin_port);
  }
  static std::string read(const Descriptor& connection, std::size_t size) {
    std::string text(size, '\0');
    return ::recv(connection.get(), text.data(), size, MSG_WAITALL) == static_cast<ssize_t>(size) ? text : "";
  }
  /// Until the end.
  static std::string read_all(test::ByteStream& stream) {
    std::string text;
    std::array<std::uint8_t, 4096> part{};
    for (long count = 0; (count = stream.receive(part)) > 0;)
      text.append(reinterpret_cast<const char*>(part.data()), static_cast<std::size_t>(count));
    return text;
  }
  /// Whether a client is served from end to end.
  bool is_served() {
    TlsStream client(front_->port());
    if (client.send(bytes_of("ping")) != 4) return false;
    const auto connection = accepted();
    return read(connection, 4) == "ping";
  }

  const panvo::test::TemporaryFolder folder_;
  const Descriptor listener_;
  test::CertificateFiles files_;
  std::mutex mutex_;
  std::condition_variable warned_;
  std::string warnings_;
  RelayedPeers peers_;
  std::optional<TlsFront> front_;
};

TEST_F(TlsFrontTest, HandsBytesOnAndTellsWhoseTheyAre) {
  start();
  TlsStream client(front_->port());
  EXPECT_EQ(client.server_name(), "vehicle");
  ASSERT_EQ(client.send(bytes_of("question")), 8);
  auto connection = accepted();
  const int relay_port = peer_port(connection);
  EXPECT_EQ(read(connection, 8), "question");
  EXPECT_EQ(peers_.find(relay_port), "127.0.0.1:" + std::to_string(client.own_port()));
  ::send(connection.get(), "answer", 6, 0);
  connection = Descriptor();
  EXPECT_EQ(read_all(client), "answer");
  EXPECT_TRUE(client.has_ended_properly());
  front_.reset();
  EXPECT_EQ(peers_.find(relay_port), std::nullopt);
}

TEST_F(TlsFrontTest, TellsTheServerThatAClientHasLeft) {
  start();
  std::optional<TlsStream> client(front_->port());
  ASSERT_EQ(client->send(bytes_of("question")), 8);
  const auto connection = accepted();
  client.reset();
  EXPECT_EQ(read(connection, 8), "question");
  std::array<char, 1> letter{};
  EXPECT_EQ(::recv(connection.get(), letter.data(), 1, 0), 0);
}

TEST_F(TlsFrontTest, AnswersAClientThatHasSentItsLast) {
  start();
  TlsStream client(front_->port());
  ASSERT_EQ(client.send(bytes_of("question")), 8);
  client.end();
  auto connection = accepted();
  EXPECT_EQ(read(connection, 8), "question");
  const timeval patience{20, 0};
  ::setsockopt(connection.get(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  std::array<char, 1> letter{};
  EXPECT_EQ(::recv(connection.get(), letter.data(), 1, 0), 0);
  ::send(connection.get(), "answer", 6, 0);
  connection = Descriptor();
  EXPECT_EQ(read_all(client), "answer");
}

TEST_F(TlsFrontTest, AnswersPlainHttp) {
  start();
  const auto client = plain_stream(front_->port(), 0);
  client->send(bytes_of("GET / HTTP/1.1\r\nHost: localhost\r\nX-Long: " + std::string(10'000, 'x') + "\r\n\r\n"));
  EXPECT_THAT(read_all(*client),
              AllOf(StartsWith("HTTP/1.1 400 "), EndsWith("\r\n\r\nthis port speaks TLS: use https:// "
                                                          "or wss:// for it\n")));
  EXPECT_TRUE(is_warned("127.0.0.1:" + std::to_string(client->own_port()) + ": no TLS: it speaks HTTP without TLS"));
}

TEST_F(TlsFrontTest, ClosesAClientThatSendsRubbish) {
  start();
  const auto client = plain_stream(front_->port(), 0);
  client->send(bytes_of("not a TLS handshake"));
  read_all(*client);
  EXPECT_TRUE(is_warned("no TLS: wrong version number"));
  EXPECT_TRUE(is_served());
}

TEST_F(TlsFrontTest, ServesOthersWhileManyStallInTheHandshake) {
  start();
  std::vector<std::unique_ptr<test::ByteStream>> stalled;
  for (int i = 0; i < 200; ++i) {
    stalled.push_back(plain_stream(front_->port(), 0));
    stalled.back()->send(bytes_of("\x16\x03\x01"));
  }
  EXPECT_TRUE(is_served());
}

TEST_F(TlsFrontTest, GivesUpTheOldestHandshakeForANewClient) {
  start({.max_handshakes = 2, .handshake_timeout = std::chrono::hours(1)});
  const auto first = plain_stream(front_->port(), 0), second = plain_stream(front_->port(), 0),
             third = plain_stream(front_->port(), 0);
  std::array<std::uint8_t, 1> byte{};
  EXPECT_EQ(first->receive(byte), 0);
  EXPECT_TRUE(is_served());
}

TEST_F(TlsFrontTest, GivesUpAHandshakeThatTakesTooLong) {
  start({.handshake_timeout = std::chrono::milliseconds(50)});
  const auto client = plain_stream(front_->port(), 0);
  std::array<std::uint8_t, 1> byte{};
  EXPECT_EQ(client->receive(byte), 0);
}

TEST_F(TlsFrontTest, ClosesClientsBeyondTheMost) {
  start({.max_relays = 1});
  TlsStream first(front_->port());
  ASSERT_EQ(first.send(bytes_of("ping")), 4);
  const auto connection = accepted();
  ASSERT_EQ(read(connection, 4), "ping");
  TlsStream second(front_->port());
  std::array<std::uint8_t, 1> byte{};
  EXPECT_LE(second.receive(byte), 0);
  EXPECT_TRUE(is_warned("more than 1"));
  EXPECT_EQ(first.send(bytes_of("pong")), 4);
  EXPECT_EQ(read(connection, 4), "pong");
}

TEST_F(TlsFrontTest, MakesTheServerWaitForASlowClientAndLosesNothing) {
  start();
  TlsStream client(front_->port(), 4096);
  ASSERT_EQ(client.send(bytes_of("ping")), 4);
  auto connection = accepted();
  ASSERT_EQ(read(connection, 4), "ping");  // else closing it breaks the connection
  const std::vector<std::uint8_t> part(65'521, 7);
  std::size_t sent = 0;
  constexpr std::size_t kMost = 64'000'000;
  for (pollfd room{connection.get(), POLLOUT, 0}; sent < kMost && ::poll(&room, 1, 1000) == 1;) {
    const ssize_t count = ::send(connection.get(), part.data(), part.size(), MSG_DONTWAIT);
    ASSERT_GT(count, 0);
    sent += static_cast<std::size_t>(count);
  }
  EXPECT_LT(sent, kMost / 2);  // sockets hold a few megabytes
  connection = Descriptor();
  EXPECT_EQ(read_all(client).size(), sent);
  EXPECT_TRUE(client.has_ended_properly());
}

TEST_F(TlsFrontTest, TakesRenewedFilesOnceTheyFitTogether) {
  start();
  const auto next = make_certificate(folder_.path(), "renewed");
  std::filesystem::rename(next.certificate, files_.certificate);
  EXPECT_EQ(TlsStream(front_->port()).server_name(), "vehicle");
  EXPECT_TRUE(is_warned("the former certificate stays in use"));
  std::filesystem::rename(next.key, files_.key);
  EXPECT_EQ(TlsStream(front_->port()).server_name(), "renewed");
}

}  // namespace
}  // namespace panvo::web_view
