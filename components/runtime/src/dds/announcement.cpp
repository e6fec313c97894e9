// SPDX-License-Identifier: Apache-2.0
#include "announcement.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace panvo::runtime::dds {

bool is_announcement(std::span<const std::uint8_t> message) {
  constexpr std::size_t kHeader = 20, kSubmessageHeader = 4;
  constexpr std::uint8_t kData = 0x15, kLittleEndian = 0x01;
  constexpr std::size_t kWriterId = 8;  // after flags, offset of the inline QoS and reader
  constexpr std::array<std::uint8_t, 4> kAnnouncingWriter{0, 1, 0, 0xc2};
  std::size_t at = kHeader;
  while (at + kSubmessageHeader <= message.size()) {
    const auto submessage = message.subspan(at);
    const auto content = submessage.subspan(kSubmessageHeader);
    if (submessage[0] == kData && content.size() >= kWriterId + kAnnouncingWriter.size() &&
        std::ranges::equal(content.subspan(kWriterId, kAnnouncingWriter.size()), kAnnouncingWriter)) {
      return true;
    }
    const bool is_little = (submessage[1] & kLittleEndian) != 0;
    const std::size_t length =
        is_little ? submessage[2] | std::size_t{submessage[3]} << 8 : submessage[3] | std::size_t{submessage[2]} << 8;
    if (length == 0) return false;  // reaches to the end of the message
    at += kSubmessageHeader + length;
  }
  return false;
}

}  // namespace panvo::runtime::dds
