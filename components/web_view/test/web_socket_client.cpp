// SPDX-License-Identifier: Apache-2.0
#include "web_socket_client.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <stdexcept>

namespace panvo::web_view::test {

int connected_socket(int port, int receive_buffer) {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  const timeval patience{20, 0};
  ::setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
  if (receive_buffer > 0) ::setsockopt(socket, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof(receive_buffer));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
    ::close(socket);
    throw std::runtime_error("cannot connect to port " + std::to_string(port));
  }
  return socket;
}

int port_of(int socket) {
  sockaddr_in name{};
  socklen_t size = sizeof name;
  ::getsockname(socket, reinterpret_cast<sockaddr*>(&name), &size);
  return ntohs(name.sin_port);
}

namespace {

class PlainStream final : public ByteStream {
 public:
  explicit PlainStream(int socket) : socket_(socket) {}
  ~PlainStream() override { ::close(socket_); }
  PlainStream(const PlainStream&) = delete;
  PlainStream& operator=(const PlainStream&) = delete;

  int own_port() const override { return port_of(socket_); }
  long send(std::span<const std::uint8_t> bytes) override {
    return ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }
  long receive(std::span<std::uint8_t> bytes) override { return ::recv(socket_, bytes.data(), bytes.size(), 0); }

 private:
  const int socket_;
};

}  // namespace

std::unique_ptr<ByteStream> plain_stream(int port, int receive_buffer) {
  return std::make_unique<PlainStream>(connected_socket(port, receive_buffer));
}

std::string http_answer(int port, const std::string& request, const Connect& connect) {
  const auto stream = connect(port, 0);
  std::string answer;
  std::array<std::uint8_t, 4096> part{};
  stream->send({reinterpret_cast<const std::uint8_t*>(request.data()), request.size()});
  for (long count = 0; (count = stream->receive(part)) > 0;)
    answer.append(reinterpret_cast<const char*>(part.data()), static_cast<std::size_t>(count));
  return answer;
}

WebSocketClient::WebSocketClient(int port, const Request& request)
    : stream_(request.connect(port, request.receive_buffer)) {
  const std::string text = "GET " + request.path +
                           " HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                           "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" +
                           request.headers + "\r\n";
  send_raw({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  std::array<std::uint8_t, 1> letter{};
  while (!answer_.ends_with("\r\n\r\n") && receive_exactly(letter)) answer_ += static_cast<char>(letter[0]);
  if (answer_.starts_with("HTTP/1.1 ")) status_ = std::stoi(answer_.substr(9, 3));
}

void WebSocketClient::send(std::uint8_t head, std::span<const std::uint8_t> data) {
  std::vector<std::uint8_t> frame{head};
  constexpr std::uint8_t kMasked = 0x80;
  if (data.size() < 126) {
    frame.push_back(static_cast<std::uint8_t>(kMasked | data.size()));
  } else {
    frame.push_back(kMasked | 127);
    for (int shift = 56; shift >= 0; shift -= 8)
      frame.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(data.size()) >> shift));
  }
  constexpr std::array<std::uint8_t, 4> kMask{1, 2, 3, 4};
  frame.insert(frame.end(), kMask.begin(), kMask.end());
  for (std::size_t i = 0; i < data.size(); ++i) frame.push_back(data[i] ^ kMask[i % 4]);
  send_raw(frame);
}

void WebSocketClient::send_raw(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const long sent = stream_->send(bytes);
    if (sent <= 0) return;  // the server has closed the connection, which receive() will show
    bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
}

bool WebSocketClient::receive_exactly(std::span<std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const long count = stream_->receive(bytes);
    if (count <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return true;
}

std::optional<WebSocketClient::Frame> WebSocketClient::receive() {
  constexpr std::uint8_t kPing = 9, kPong = 10;
  while (true) {
    std::array<std::uint8_t, 2> head{};
    if (!receive_exactly(head)) return std::nullopt;
    std::uint64_t size = head[1];
    if (size >= 126) {
      std::vector<std::uint8_t> longer(size == 126 ? 2 : 8);
      if (!receive_exactly(longer)) return std::nullopt;
      size = 0;
      for (const auto byte : longer) size = size << 8 | byte;
    }
    Frame frame{static_cast<std::uint8_t>(head[0] & 0x0f), std::vector<std::uint8_t>(size)};
    if (!receive_exactly(frame.data)) return std::nullopt;
    if (frame.operation == kPing) {
      send(0x80 | kPong, frame.data);
    } else if (frame.operation != kPong) {
      return frame;
    }
  }
}

}  // namespace panvo::web_view::test
