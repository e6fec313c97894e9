// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace panvo::interfaces {

struct CdrLayout;

/// How one member of a message lies in CDR bytes.
struct CdrField {
  std::string_view name;
  std::uint8_t size = 0;  ///< of a primitive, which is also its alignment
  bool is_string = false;
  const CdrLayout* nested = nullptr;  ///< of a member that is a message
  std::uint32_t array_size = 1;       ///< elements of a fixed array
  bool is_sequence = false;           ///< led by the number of its elements
};

struct CdrLayout {
  std::span<const CdrField> fields;
};

/// Of every message, in the order of message_types().
std::span<const CdrLayout* const> cdr_layouts();

/// Walks through the bytes of a message, without its encapsulation header, and throws DecodeError naming type and member where they end
/// too early. The decoder allocates what a length says before it looks whether that many bytes are there: this looks first.
void check_cdr(std::string_view type_name, const CdrLayout& layout, std::span<const std::uint8_t> payload,
               std::endian order);

/// Sets the bytes between the members of a little-endian message to zero: the encoder steps over them, and what lay there before would
/// go out with the message and make equal messages differ.
void clear_padding(std::string_view type_name, const CdrLayout& layout, std::span<std::uint8_t> payload);

}  // namespace panvo::interfaces
