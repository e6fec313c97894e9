// SPDX-License-Identifier: Apache-2.0
#include "usbip_link.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <thread>

namespace panvo::test {
namespace {

// Messages of USB/IP: twelve big-endian words; the first is the command.
constexpr std::size_t kWords = 12, kSetupAt = 10;
constexpr std::uint32_t kSubmit = 1, kUnlink = 2, kSubmitted = 3, kUnlinked = 4;
constexpr int kHighSpeed = 3;
using Words = std::array<std::uint32_t, kWords>;

bool attach(int port, int socket) {
  const int file = open("/sys/devices/platform/vhci_hcd.0/attach", O_WRONLY | O_CLOEXEC);
  if (file < 0) throw std::runtime_error("no virtual USB controller: vhci-hcd is not loaded");
  const std::string text = std::to_string(port) + " " + std::to_string(socket) + " " + std::to_string(0x10002 + port) +
                           " " + std::to_string(kHighSpeed);
  const bool is_attached = ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  close(file);
  return is_attached;
}

Bytes bytes_of(const Words& words) {
  Bytes bytes(sizeof words);
  std::memcpy(bytes.data(), words.data(), bytes.size());
  return bytes;
}

}  // namespace

UsbipLink::UsbipLink(int port) {
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (true) {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
      throw std::runtime_error("cannot create a socket");
    const bool is_attached = attach(port, ends[1]);
    close(ends[1]);  // the kernel holds its own reference
    socket_ = ends[0];
    if (is_attached) return;
    close(socket_);
    if (std::chrono::steady_clock::now() > give_up)
      throw std::runtime_error("the USB port " + std::to_string(port) + " remains in use");
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

UsbipLink::~UsbipLink() {
  shutdown(socket_, SHUT_RDWR);
  close(socket_);
}

std::optional<UsbRequest> UsbipLink::receive(std::chrono::milliseconds limit) {
  pollfd waiting{socket_, POLLIN, 0};
  if (poll(&waiting, 1, static_cast<int>(limit.count())) <= 0) return std::nullopt;
  Words words{};
  is_alive_ = read(words.data(), sizeof words);
  if (!is_alive_) return std::nullopt;
  UsbRequest request;
  request.number = ntohl(words[1]);
  request.is_in = ntohl(words[3]) != 0;
  request.endpoint = ntohl(words[4]);
  if (ntohl(words[0]) == kUnlink) {
    request.is_unlink = true;
    request.unlinked = ntohl(words[5]);
    return request;
  }
  if (ntohl(words[0]) != kSubmit) throw std::runtime_error("USB/IP: unknown message");
  request.length = ntohl(words[6]);
  std::memcpy(request.setup, &words[kSetupAt], sizeof request.setup);
  if (!request.is_in && request.length > 0) {
    request.data.resize(request.length);
    is_alive_ = read(request.data.data(), request.data.size());
  }
  return request;
}

void UsbipLink::answer(std::uint32_t number, const Bytes& data) {
  send_return(number, 0, static_cast<std::uint32_t>(data.size()), data);
}
void UsbipLink::answer_taken(std::uint32_t number, std::uint32_t sent) { send_return(number, 0, sent, {}); }
void UsbipLink::refuse(std::uint32_t number) { send_return(number, -EPIPE, 0, {}); }

void UsbipLink::send_return(std::uint32_t number, int status, std::uint32_t length, const Bytes& data) {
  Words words{};
  words[0] = htonl(kSubmitted);
  words[1] = htonl(number);
  words[5] = htonl(static_cast<std::uint32_t>(status));
  words[6] = htonl(length);
  Bytes message = bytes_of(words);
  message.insert(message.end(), data.begin(), data.end());
  write(message);
}

void UsbipLink::answer_unlink(std::uint32_t number, bool was_waiting) {
  Words words{};
  words[0] = htonl(kUnlinked);
  words[1] = htonl(number);
  words[5] = htonl(static_cast<std::uint32_t>(was_waiting ? -ECONNRESET : 0));
  write(bytes_of(words));
}

bool UsbipLink::read(void* target, std::size_t size) {
  auto* bytes = static_cast<std::uint8_t*>(target);
  while (size > 0) {
    const ssize_t count = recv(socket_, bytes, size, 0);
    if (count <= 0) return false;
    bytes += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

void UsbipLink::write(const Bytes& bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = send(socket_, bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL);
    if (count <= 0) {
      is_alive_ = false;
      return;
    }
    done += static_cast<std::size_t>(count);
  }
}

}  // namespace panvo::test
