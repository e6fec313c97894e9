// SPDX-License-Identifier: Apache-2.0
#include "web_server.hpp"

#include <civetweb.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "access.hpp"
#include "tls_front.hpp"

namespace panvo::web_view {
namespace {

constexpr const char* kSendTimeout = "5000";  // ms without progress, after which a client counts as gone
constexpr const char* kPingPeriod = "2000";   // ms of silence, after which a client is asked whether it is there
constexpr std::size_t kMaxSecret = 1024;
constexpr std::size_t kWaitingClients = 32;  // with TLS: those that no thread of civetweb serves yet
constexpr const char* kOnlyRelayed = "this port is for the relayed connections of TLS only";

std::string header_of(const mg_connection* connection, const char* name) {
  const char* const header = mg_get_header(connection, name);
  return header ? header : "";
}

/// NAME=VALUE of the address; empty if it is not there.
std::string query_value(const mg_connection* connection, const char* name) {
  const char* const query = mg_get_request_info(connection)->query_string;
  std::array<char, kMaxSecret> value{};
  if (!query || mg_get_var(query, std::strlen(query), name, value.data(), value.size()) <= 0) return "";
  return value.data();
}

std::string token_of(const mg_connection* connection) {
  const std::string header = header_of(connection, "Authorization");
  if (const auto token = bearer_token(header); !token.empty()) return std::string(token);
  return query_value(connection, "token");
}

Credentials credentials_of(const mg_connection* connection, const std::string& cookie_name) {
  std::array<char, kMaxSecret> cookie{};
  const std::string cookies = header_of(connection, "Cookie");
  const int length = mg_get_cookie(cookies.c_str(), cookie_name.c_str(), cookie.data(), cookie.size());
  return {token_of(connection), length > 0 ? cookie.data() : "", header_of(connection, "Origin")};
}

/// Whether a client asks for one of the server's subprotocols. civetweb's own answer may be that of an earlier connection.
bool asks_for_one_of(const mg_connection* connection, const std::vector<std::string>& subprotocols) {
  constexpr std::string_view kBlank = " \t";
  const auto* const request = mg_get_request_info(connection);
  for (int i = 0; i < request->num_headers; ++i) {
    if (mg_strcasecmp(request->http_headers[i].name, "Sec-WebSocket-Protocol") != 0) continue;
    std::string_view rest = request->http_headers[i].value;
    while (!rest.empty()) {
      std::string_view name = rest.substr(0, rest.find(','));
      rest.remove_prefix(std::min(rest.size(), name.size() + 1));
      name.remove_prefix(std::min(name.size(), name.find_first_not_of(kBlank)));
      name = name.substr(0, name.find_last_not_of(kBlank) + 1);
      if (std::ranges::find(subprotocols, name) != subprotocols.end()) return true;
    }
  }
  return false;
}

/// mg_send_http_error() leaves out the head of its answer to a request for a WebSocket.
void answer(mg_connection* connection, const HttpResponse& response, bool has_body = true) {
  std::string head = "HTTP/1.1 " + std::to_string(response.status) + ' ' +
                     mg_get_response_code_text(connection, response.status) + "\r\nConnection: close\r\n";
  if (!response.content_type.empty()) head += "Content-Type: " + response.content_type + "\r\n";
  for (const auto& [name, value] : response.headers) head.append(name).append(": ").append(value).append("\r\n");
  head += "Content-Length: " + std::to_string(response.body.size()) + "\r\n\r\n";
  if (has_body) head += response.body;
  mg_write(connection, head.data(), head.size());
}

void answer(mg_connection* connection, int status, const std::string& text) {
  answer(connection, HttpResponse{status, "text/plain; charset=utf-8", text + '\n', {}});
}

}  // namespace

/// A connection with its session.
struct WebServer::Open {
  Open(mg_connection* handle, std::string address) : connection(handle, std::move(address)) {}
  Connection connection;
  std::unique_ptr<Session> session;  // destroyed before the connection, which it uses
};

/// The callbacks of civetweb, which is written in C: no exception may pass through it.
struct WebServer::Handlers {
  /// 0: accepted.
  static int connect(const mg_connection* connection, void* server) {
    auto* const writable = const_cast<mg_connection*>(connection);  // for the answer
    try {
      const auto& self = *static_cast<const WebServer*>(server);
      if (!self.address_of(connection)) {
        answer(writable, 403, kOnlyRelayed);
        return 1;
      }
      if (!asks_for_one_of(connection, self.settings_.subprotocols)) {
        answer(writable, 400, "the WebSocket subprotocol is missing or not supported");
        return 1;
      }
      if (const auto refusal = self.callbacks_.admit(credentials_of(connection, self.settings_.cookie))) {
        answer(writable, refusal->http_status, refusal->reason);
        return 1;
      }
      return 0;
    } catch (const std::exception&) {
      return 1;
    }
  }

  static void ready(mg_connection* connection, void* server) {
    try {
      const auto& self = *static_cast<const WebServer*>(server);
      auto open = std::make_unique<Open>(connection, self.address_of(connection).value_or("a client that has left"));
      open->session = self.callbacks_.open(open->connection);
      mg_set_user_connection_data(connection, open.release());
    } catch (const std::exception&) {  // without a session the first frame ends the connection
    }
  }

  /// 1: keep the connection.
  static int data(mg_connection* connection, int head, char* data, std::size_t size, void*) {
    constexpr int kOperation = 0x0f, kClose = 8;
    auto* const open = static_cast<Open*>(mg_get_user_connection_data(connection));
    if (!open || (head & kOperation) == kClose) return 0;
    try {
      open->session->receive(static_cast<std::uint8_t>(head), {reinterpret_cast<const std::uint8_t*>(data), size});
      return 1;
    } catch (const std::exception&) {
      return 0;
    }
  }

  static void close(const mg_connection* connection, void*) {
    delete static_cast<Open*>(mg_get_user_connection_data(connection));
    mg_set_user_connection_data(connection, nullptr);
  }

  /// civetweb's own messages are about single requests.
  static int log(const mg_connection*, const char*) { return 1; }

  /// Returns the HTTP status.
  static int get(mg_connection* connection, void* server) {
    const auto& self = *static_cast<const WebServer*>(server);
    try {
      if (!self.address_of(connection)) {
        answer(connection, 403, kOnlyRelayed);
        return 403;
      }
      const auto* const info = mg_get_request_info(connection);
      const std::string_view method = info->request_method;
      if (method != "GET" && method != "HEAD") {
        answer(connection, {405, "text/plain", "only GET and HEAD\n", {{"Allow", "GET, HEAD"}}});
        return 405;
      }
      const auto response =
          self.callbacks_.get(credentials_of(connection, self.settings_.cookie),
                              {info->local_uri, header_of(connection, "Host"), header_of(connection, "If-None-Match"),
                               !self.settings_.tls.is_empty()});
      answer(connection, response, method == "GET");
      return response.status;
    } catch (const std::exception& error) {
      answer(connection, 500, error.what());
      return 500;
    }
  }
};

WebServer::Connection::Connection(mg_connection* connection, std::string address)
    : connection_(connection),
      address_(std::move(address)),
      socket_(mg_get_request_info(connection)->remote_addr, mg_get_request_info(connection)->remote_port,
              mg_get_request_info(connection)->server_port) {}

bool WebServer::Connection::send_text(std::string_view text) {
  return mg_websocket_write(connection_, MG_WEBSOCKET_OPCODE_TEXT, text.data(), text.size()) > 0;
}

bool WebServer::Connection::send_binary(std::span<const std::uint8_t> frame) {
  return mg_websocket_write(connection_, MG_WEBSOCKET_OPCODE_BINARY, reinterpret_cast<const char*>(frame.data()),
                            frame.size()) > 0;
}

std::string WebServer::Connection::option(const char* name) const { return query_value(connection_, name); }

void WebServer::Connection::close() { socket_.shut_down(); }

WebServer::WebServer(Settings settings, Callbacks callbacks)
    : settings_(std::move(settings)), callbacks_(std::move(callbacks)) {
  for (const auto& name : settings_.subprotocols) subprotocol_names_.push_back(name.c_str());
  subprotocols_ = std::make_unique<mg_websocket_subprotocols>(
      mg_websocket_subprotocols{static_cast<int>(subprotocol_names_.size()), subprotocol_names_.data()});
  mg_init_library(MG_FEATURES_WEBSOCKET);
  try {
    listen();
    if (!settings_.tls.is_empty()) {
      front_ = std::make_unique<TlsFront>(
          TlsFront::Settings{.host = settings_.host,
                             .port = settings_.port,
                             .files = settings_.tls,
                             .inner_port = port_,
                             .max_relays = static_cast<std::size_t>(settings_.threads) + kWaitingClients},
          peers_, callbacks_.warn);
      port_ = front_->port();
    }
  } catch (...) {
    stop();
    throw;
  }
}

void WebServer::listen() {
  const std::string address =
      settings_.tls.is_empty() ? settings_.host + ":" + std::to_string(settings_.port) : "127.0.0.1:0";
  const std::string threads = std::to_string(settings_.threads);
  const std::array<const char*, 15> options{"listening_ports",
                                            address.c_str(),
                                            "num_threads",
                                            threads.c_str(),
                                            "request_timeout_ms",
                                            kSendTimeout,
                                            "websocket_timeout_ms",
                                            kPingPeriod,
                                            "enable_websocket_ping_pong",
                                            "yes",
                                            "tcp_nodelay",
                                            "1",
                                            "enable_directory_listing",
                                            "no",
                                            nullptr};
  mg_callbacks callbacks{};
  callbacks.log_message = Handlers::log;
  std::array<char, 256> reason{};
  mg_init_data init{&callbacks, this, const_cast<const char**>(options.data())};
  mg_error_data error{};
#if CIVETWEB_VERSION_MAJOR == 1 && CIVETWEB_VERSION_MINOR < 16
  unsigned code = 0;
  error.code = &code;
#endif
  error.text = reason.data();
  error.text_buffer_size = reason.size();
  context_ = mg_start2(&init, &error);
  if (!context_) throw ServerError("cannot listen on " + address + ": " + reason.data());
  mg_server_port port{};
  if (mg_get_server_ports(context_, 1, &port) == 1) port_ = port.port;
  mg_set_websocket_handler_with_subprotocols(context_, "/", subprotocols_.get(), Handlers::connect, Handlers::ready,
                                             Handlers::data, Handlers::close, this);
  mg_set_request_handler(context_, "/", Handlers::get, this);
}

/// Who is at the other end: "192.168.1.7:43210". nullopt: with TLS, one that goes round it.
std::optional<std::string> WebServer::address_of(const mg_connection* connection) const {
  const auto* const request = mg_get_request_info(connection);
  const std::string host = request->remote_addr;
  if (settings_.tls.is_empty()) return host + ":" + std::to_string(request->remote_port);
  return host == "127.0.0.1" ? peers_.find(request->remote_port) : std::nullopt;
}

void WebServer::stop() {
  front_.reset();  // first: its connections then end, which threads of civetweb may wait for
  if (context_) mg_stop(context_);
  mg_exit_library();
}

WebServer::~WebServer() { stop(); }

}  // namespace panvo::web_view
