// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace panvo::web_view::test {

/// Sends an HTTP request to a port of this machine; the answer until the server ends the connection.
std::string http_answer(int port, const std::string& request);

/// A WebSocket client over a plain socket of this machine, so that tests can also send what no library sends.
class WebSocketClient {
 public:
  struct Frame {
    std::uint8_t operation;  ///< 1: text, 2: binary, 8: close
    std::vector<std::uint8_t> data;
    std::string text() const { return {data.begin(), data.end()}; }
  };
  struct Request {
    std::string path = "/";
    std::string headers = "Sec-WebSocket-Protocol: foxglove.sdk.v1\r\n";  ///< each with its line end
    int receive_buffer = 0;                                               ///< bytes of the socket; 0: default
  };

  /// Connects and asks for the protocol; status() and answer() are the server's reply.
  explicit WebSocketClient(int port) : WebSocketClient(port, Request{}) {}
  WebSocketClient(int port, const Request& request);
  ~WebSocketClient();
  WebSocketClient(const WebSocketClient&) = delete;
  WebSocketClient& operator=(const WebSocketClient&) = delete;

  int status() const { return status_; }  ///< of HTTP; 101: connected; 0: none
  const std::string& answer() const { return answer_; }

  void send_text(std::string_view text) {
    send(0x81, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }
  void send_binary(std::span<const std::uint8_t> data) { send(0x82, data); }
  /// A frame with this first byte.
  void send(std::uint8_t head, std::span<const std::uint8_t> data);
  void send_raw(std::span<const std::uint8_t> bytes);

  /// The next text, binary or close frame; pings are answered. nullopt: the connection has ended, or nothing came within
  /// 20 s.
  std::optional<Frame> receive();

 private:
  bool receive_exactly(std::span<std::uint8_t> bytes);

  int socket_ = -1;
  int status_ = 0;
  std::string answer_;
};

}  // namespace panvo::web_view::test
