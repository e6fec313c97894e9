// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "relayed_peers.hpp"
#include "tls_files.hpp"

namespace panvo::web_view {

/// Accepts TLS connections, and hands their bytes on to a plain port of this machine: civetweb 1.15 crashes with
/// OpenSSL 3. One thread serves all clients; none of them can make it wait.
class TlsFront {
 public:
  struct Settings {
    std::string host = "127.0.0.1";
    int port = 0;  ///< 0: any free port
    TlsFiles files = {};
    int inner_port = 0;                ///< of 127.0.0.1, which gets the bytes
    std::size_t max_relays = 44;       ///< further clients are closed after their handshake
    std::size_t max_handshakes = 256;  ///< at a time; for a further one, the oldest is given up
    std::chrono::milliseconds handshake_timeout{5000};
  };
  /// A problem worth a warning; `kind`: for those that may come often.
  using Warn = std::function<void(const std::string& kind, const std::string& text)>;

  /// Throws CertificateError, or ServerError if it cannot listen. `warn` is called by the thread of the front.
  TlsFront(Settings settings, RelayedPeers& peers, Warn warn);
  /// Ends all connections.
  ~TlsFront();
  TlsFront(const TlsFront&) = delete;
  TlsFront& operator=(const TlsFront&) = delete;

  int port() const;

 private:
  class Loop;
  std::unique_ptr<Loop> loop_;
};

}  // namespace panvo::web_view
