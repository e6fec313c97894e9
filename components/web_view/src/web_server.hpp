// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "http.hpp"
#include "peer_socket.hpp"
#include "relayed_peers.hpp"
#include "tls_files.hpp"

struct mg_connection;
struct mg_context;
struct mg_websocket_subprotocols;

namespace panvo::web_view {

class TlsFront;

/// Thrown if the server cannot start: the port is in use, the address does not exist.
class ServerError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// civetweb: WebSocket connections, each with its own thread, which calls its Session, and files by GET. No exception
/// leaves a callback.
class WebServer {
 public:
  /// An open connection. Thread-safe.
  class Connection {
   public:
    Connection(mg_connection* connection, std::string address);
    /// Sends one message, waiting as long as the client reads. False if it read nothing for kSendTimeout, or is gone.
    bool send_text(std::string_view text);
    bool send_binary(std::span<const std::uint8_t> frame);
    /// Ends the connection soon; its Session is then destroyed.
    void close();
    /// "192.168.1.7:43210".
    const std::string& address() const { return address_; }
    /// A value of the address that the client opened, ws://HOST:PORT?NAME=VALUE; empty: none.
    std::string option(const char* name) const;

   private:
    mg_connection* const connection_;
    const std::string address_;
    PeerSocket socket_;
  };

  /// What an application does for a connection. Created, called and destroyed by the thread of the connection.
  class Session {
   public:
    virtual ~Session() = default;
    /// A frame; `head` is its first byte.
    virtual void receive(std::uint8_t head, std::span<const std::uint8_t> data) = 0;
  };

  struct Settings {
    std::string host = "127.0.0.1";
    int port = 0;  ///< 0: any free port
    int threads = 10;
    std::vector<std::string> subprotocols;  ///< a WebSocket client must ask for one of them
    std::string cookie;                     ///< name of the one that the server sets
    TlsFiles tls;                           ///< none: connections are not encrypted
  };
  struct Refusal {
    int http_status;
    std::string reason;
  };
  struct Callbacks {
    /// Whether a WebSocket is accepted: nullopt.
    std::function<std::optional<Refusal>(const Credentials&)> admit;
    std::function<std::unique_ptr<Session>(Connection&)> open;
    std::function<HttpResponse(const Credentials&, const HttpRequest&)> get;
    /// A problem of TLS; `kind`: for those that may come often.
    std::function<void(const std::string& kind, const std::string& text)> warn;
  };

  /// Throws ServerError, CertificateError.
  WebServer(Settings settings, Callbacks callbacks);
  /// Closes all connections and destroys their sessions.
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  int port() const { return port_; }

 private:
  struct Handlers;
  struct Open;

  void listen();
  std::optional<std::string> address_of(const mg_connection* connection) const;
  void stop();

  const Settings settings_;
  const Callbacks callbacks_;
  std::vector<const char*> subprotocol_names_;
  std::unique_ptr<mg_websocket_subprotocols> subprotocols_;  // civetweb keeps the address
  mg_context* context_ = nullptr;
  int port_ = 0;
  RelayedPeers peers_;               // of the front
  std::unique_ptr<TlsFront> front_;  // with TLS: civetweb then listens on this machine only
};

}  // namespace panvo::web_view
