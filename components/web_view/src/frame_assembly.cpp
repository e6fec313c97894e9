// SPDX-License-Identifier: Apache-2.0
#include "frame_assembly.hpp"

#include <string>
#include <utility>

#include "protocol_error.hpp"

namespace panvo::web_view {

std::optional<WebSocketMessage> FrameAssembly::add(std::uint8_t head, std::span<const std::uint8_t> data) {
  constexpr std::uint8_t kFinal = 0x80, kOperation = 0x0f, kContinuation = 0, kText = 1, kBinary = 2, kControl = 8;
  const std::uint8_t operation = head & kOperation;
  const bool is_final = (head & kFinal) != 0;
  if (operation >= kControl) return std::nullopt;
  const auto refuse = [&](const std::string& why) {
    begun_.reset();
    is_skipping_ = !is_final;
    throw ProtocolError(why);
  };
  if (operation == kContinuation && is_skipping_) {
    is_skipping_ = !is_final;
    return std::nullopt;
  }
  if (operation > kBinary) refuse("a frame has an unknown operation");
  if ((operation == kContinuation) != begun_.has_value()) refuse("a fragment of a message is out of order");
  if (!begun_) begun_ = WebSocketMessage{operation == kText, {}};
  if (begun_->data.size() + data.size() > max_bytes_)
    refuse("a message is larger than " + std::to_string(max_bytes_) + " bytes");
  begun_->data.insert(begun_->data.end(), data.begin(), data.end());
  if (!is_final) return std::nullopt;
  return std::exchange(begun_, std::nullopt);
}

}  // namespace panvo::web_view
