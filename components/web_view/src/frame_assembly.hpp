// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace panvo::web_view {

/// A complete message of a WebSocket client.
struct WebSocketMessage {
  bool is_text;
  std::vector<std::uint8_t> data;
};

/// Joins the frames of a WebSocket connection to messages of bounded size [RFC 6455 section 5.4].
class FrameAssembly {
 public:
  explicit FrameAssembly(std::size_t max_bytes) : max_bytes_(max_bytes) {}

  /// `head`: first byte of the frame. Returns a message once it is complete; control frames give none. After a
  /// ProtocolError (too large, out of order) the begun message is forgotten.
  std::optional<WebSocketMessage> add(std::uint8_t head, std::span<const std::uint8_t> data);

 private:
  const std::size_t max_bytes_;
  std::optional<WebSocketMessage> begun_;
  bool is_skipping_ = false;  // the rest of a message that was refused
};

}  // namespace panvo::web_view
