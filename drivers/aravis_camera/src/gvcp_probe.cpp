// SPDX-License-Identifier: Apache-2.0
#include "gvcp_probe.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdint>

namespace panvo::aravis_camera {
namespace {

class Socket {
 public:
  Socket() : descriptor_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {}
  ~Socket() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace

bool answers(const std::string& address, std::chrono::milliseconds limit) {
  constexpr std::uint16_t kGvcpPort = 3956;
  // GigE Vision control protocol: key, flags (acknowledge), DISCOVERY_CMD, payload length 0, request id 1; the reply is
  // DISCOVERY_ACK.
  constexpr std::array<std::uint8_t, 8> kDiscovery{0x42, 0x01, 0x00, 0x02, 0x00, 0x00, 0x00, 0x01};
  constexpr std::uint8_t kDiscoveryAck = 0x03;
  sockaddr_in device{};
  device.sin_family = AF_INET;
  device.sin_port = htons(kGvcpPort);
  if (inet_pton(AF_INET, address.c_str(), &device.sin_addr) != 1) return false;
  const Socket socket;
  // On a connected socket, a closed port is reported immediately.
  if (socket.descriptor() < 0 ||
      connect(socket.descriptor(), reinterpret_cast<const sockaddr*>(&device), sizeof device) != 0 ||
      send(socket.descriptor(), kDiscovery.data(), kDiscovery.size(), 0) < 0)
    return false;
  pollfd wait{.fd = socket.descriptor(), .events = POLLIN, .revents = 0};
  if (poll(&wait, 1, static_cast<int>(limit.count())) != 1) return false;
  std::array<std::uint8_t, 1024> answer{};
  const auto length = recv(socket.descriptor(), answer.data(), answer.size(), MSG_DONTWAIT);
  return length >= static_cast<ssize_t>(kDiscovery.size()) && answer[3] == kDiscoveryAck;
}

}  // namespace panvo::aravis_camera
