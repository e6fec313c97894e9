// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "descriptors.hpp"

namespace panvo::test {

/// A request of the host to the device.
struct UsbRequest {
  bool is_unlink = false;  ///< cancels the request `unlinked`
  std::uint32_t number = 0, unlinked = 0;
  bool is_in = false;
  std::uint32_t endpoint = 0;
  std::uint32_t length = 0;  ///< bytes requested or sent
  std::uint8_t setup[8] = {};
  Bytes data{};  ///< sent
};

/// A connection to a port of the kernel's virtual USB controller (vhci-hcd) with USB/IP over a socket. The destructor
/// unplugs it.
class UsbipLink {
 public:
  /// Waits until the port is free. Throws std::runtime_error if it remains in use or the controller is missing.
  explicit UsbipLink(int port);
  ~UsbipLink();
  UsbipLink(const UsbipLink&) = delete;
  UsbipLink& operator=(const UsbipLink&) = delete;

  /// nullopt: no request within `limit`, or the host has disconnected, see is_alive().
  std::optional<UsbRequest> receive(std::chrono::milliseconds limit);
  bool is_alive() const noexcept { return is_alive_; }

  /// Answers a request with data for the host, or with `sent` bytes accepted from it.
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
