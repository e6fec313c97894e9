// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace panvo::web_view {

/// The socket of an accepted connection, found among those of the process by its two ends. It refers to the connection even
/// when the server has closed its own descriptor, whose number another connection may then have.
///
/// civetweb 1.15 hides its sockets, and mg_close_connection() is safe only while the thread of the connection reads: before
/// and after, both threads close the same descriptor.
class PeerSocket {
 public:
  /// `address` and `port` of the peer, as a number: "192.168.1.7", 43210. Thread-safe.
  PeerSocket(const std::string& address, int port, int own_port);
  ~PeerSocket();
  PeerSocket(const PeerSocket&) = delete;
  PeerSocket& operator=(const PeerSocket&) = delete;

  bool is_found() const noexcept { return socket_ >= 0; }
  /// Ends the connection: the thread that reads from it finds its end. Thread-safe; does nothing if it was not found.
  void shut_down() noexcept;

 private:
  int socket_ = -1;
};

}  // namespace panvo::web_view
