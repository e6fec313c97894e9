// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "descriptors.hpp"

namespace panvo::test {

/// What the host asks of the device.
struct UsbRequest {
  bool is_unlink = false;  ///< take back the request `unlinked`
  std::uint32_t number = 0, unlinked = 0;
  bool is_in = false;
  std::uint32_t endpoint = 0;
  std::uint32_t length = 0;  ///< bytes wanted, or sent
  std::uint8_t setup[8] = {};
  Bytes data{};  ///< sent
};

/// A plug in a port of the kernel's virtual USB controller (vhci-hcd), which speaks USB/IP through a socket: unplugged with its end.
class UsbipLink {
 public:
  /// Waits until the port is free; throws std::runtime_error when it stays taken or the controller is not there.
  explicit UsbipLink(int port);
  ~UsbipLink();
  UsbipLink(const UsbipLink&) = delete;
  UsbipLink& operator=(const UsbipLink&) = delete;

  /// nullopt: nothing was asked within `limit`, or the host has let go: see is_alive().
  std::optional<UsbRequest> receive(std::chrono::milliseconds limit);
  bool is_alive() const noexcept { return is_alive_; }

  /// Answers a request with data for the host, or with `sent` bytes taken from it; `status` as an errno, negative.
  void answer(std::uint32_t number, const Bytes& data);
  void answer_taken(std::uint32_t number, std::uint32_t sent);
  void refuse(std::uint32_t number);
  void answer_unlink(std::uint32_t number, bool was_waiting);

 private:
  void send_return(std::uint32_t number, int status, std::uint32_t length, const Bytes& data);
  bool read(void* target, std::size_t size);
  void write(const Bytes& bytes);

  int socket_ = -1;
  bool is_alive_ = true;
};

}  // namespace panvo::test
