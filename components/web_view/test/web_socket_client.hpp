// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace panvo::web_view::test {

/// A socket that is connected to a port of this machine and waits up to 20 s. `receive_buffer`: bytes; 0: default. Throws
/// std::runtime_error.
int connected_socket(int port, int receive_buffer = 0);
/// Of this end of a socket.
int port_of(int socket);

/// A connection to a port of this machine.
class ByteStream {
 public:
  virtual ~ByteStream() = default;
  virtual int own_port() const = 0;
  /// How many bytes were sent or received; 0: the connection has ended; negative: it is broken, or nothing came for 20 s.
  virtual long send(std::span<const std::uint8_t> bytes) = 0;
  virtual long receive(std::span<std::uint8_t> bytes) = 0;
};
using Connect = std::function<std::unique_ptr<ByteStream>(int port, int receive_buffer)>;
/// Without encryption.
std::unique_ptr<ByteStream> plain_stream(int port, int receive_buffer);

/// Sends an HTTP request to a port of this machine; the answer until the server ends the connection.
std::string http_answer(int port, const std::string& request, const Connect& connect = plain_stream);

/// A WebSocket client of a port of this machine, so that tests can also send what no library sends.
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
    Connect connect = plain_stream;
  };

  /// Connects and asks for the protocol; status() and answer() are the server's reply.
  explicit WebSocketClient(int port) : WebSocketClient(port, Request{}) {}
  WebSocketClient(int port, const Request& request);

  int own_port() const { return stream_->own_port(); }
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

  const std::unique_ptr<ByteStream> stream_;
  int status_ = 0;
  std::string answer_;
};

}  // namespace panvo::web_view::test
