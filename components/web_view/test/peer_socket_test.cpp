// SPDX-License-Identifier: Apache-2.0
#include "peer_socket.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

namespace panvo::web_view {
namespace {

/// A connection on this machine.
class Connection {
 public:
  Connection() {
    const int listener = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in name{};
    name.sin_family = AF_INET;
    name.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof name;
    ::bind(listener, reinterpret_cast<sockaddr*>(&name), size);
    ::listen(listener, 1);
    ::getsockname(listener, reinterpret_cast<sockaddr*>(&name), &size);
    server_port_ = ntohs(name.sin_port);
    client_ = ::socket(AF_INET, SOCK_STREAM, 0);
    ::connect(client_, reinterpret_cast<sockaddr*>(&name), size);
    server_ = ::accept(listener, nullptr, nullptr);
    ::getsockname(client_, reinterpret_cast<sockaddr*>(&name), &size);
    client_port_ = ntohs(name.sin_port);
    ::close(listener);
  }
  ~Connection() {
    ::close(client_);
    if (server_ >= 0) ::close(server_);
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  int client_port() const { return client_port_; }
  int server_port() const { return server_port_; }
  int server() const { return server_; }
  void close_server() {
    ::close(server_);
    server_ = -1;
  }
  /// What the client reads: 0 at the end of the connection, -1 while it is open.
  ssize_t client_reads() const {
    char byte = 0;
    return ::recv(client_, &byte, 1, MSG_DONTWAIT);
  }

 private:
  int client_ = -1, server_ = -1, client_port_ = 0, server_port_ = 0;
};

TEST(PeerSocket, EndsTheConnectionOfItsTwoEnds) {
  const Connection other, connection;
  PeerSocket socket("127.0.0.1", connection.client_port(), connection.server_port());
  ASSERT_TRUE(socket.is_found());
  EXPECT_EQ(connection.client_reads(), -1);
  socket.shut_down();
  EXPECT_EQ(connection.client_reads(), 0);
  char byte = 0;
  EXPECT_EQ(::recv(connection.server(), &byte, 1, MSG_DONTWAIT), 0) << "the server's thread finds the end";
  EXPECT_EQ(other.client_reads(), -1);
}

TEST(PeerSocket, LeavesAConnectionAloneThatHasTheNumberOfAClosedOne) {
  Connection connection;
  const Connection next;
  PeerSocket socket("127.0.0.1", connection.client_port(), connection.server_port());
  const int number = connection.server();
  connection.close_server();
  ASSERT_EQ(::dup2(next.server(), number), number);
  socket.shut_down();
  EXPECT_EQ(next.client_reads(), -1);
  EXPECT_EQ(connection.client_reads(), 0);
  ::close(number);
}

TEST(PeerSocket, FindsNoOther) {
  const Connection connection;
  EXPECT_FALSE(PeerSocket("127.0.0.1", connection.client_port(), connection.server_port() + 1).is_found());
  EXPECT_FALSE(PeerSocket("127.0.0.2", connection.client_port(), connection.server_port()).is_found());
  PeerSocket none("127.0.0.1", 1, 1);
  none.shut_down();
  EXPECT_EQ(connection.client_reads(), -1);
}

}  // namespace
}  // namespace panvo::web_view
