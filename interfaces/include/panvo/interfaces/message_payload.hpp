// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <span>

#include "panvo/interfaces/message_type.hpp"

namespace panvo::interfaces {

/// The members of a serialised message, without encapsulation header, and their byte order.
struct Payload {
  std::span<const std::uint8_t> bytes;
  std::endian order = std::endian::native;
};

/// Payload of a message that is long enough for all its members, so that readers of type.layout need no further checks.
/// Throws DecodeError with type and member for bytes that are not a message of this type.
Payload checked_payload(const MessageType& type, std::span<const std::uint8_t> bytes);

}  // namespace panvo::interfaces
