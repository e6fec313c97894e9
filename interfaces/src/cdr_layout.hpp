// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string_view>

#include "panvo/interfaces/message_layout.hpp"

namespace panvo::interfaces {

/// Walks through the bytes of a message, without its encapsulation header, and throws DecodeError naming type and member where they end
/// too early. The decoder allocates what a length says before it looks whether that many bytes are there: this looks first.
void check_cdr(std::string_view type_name, const CdrLayout& layout, std::span<const std::uint8_t> payload,
               std::endian order);

/// Sets the bytes between the members of a little-endian message to zero: the encoder steps over them, and what lay there before would
/// go out with the message and make equal messages differ.
void clear_padding(std::string_view type_name, const CdrLayout& layout, std::span<std::uint8_t> payload);

}  // namespace panvo::interfaces
