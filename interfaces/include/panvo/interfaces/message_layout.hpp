// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "panvo/interfaces/message_type.hpp"

namespace panvo::interfaces {

/// Interpretation of the bytes of a primitive.
enum class CdrNumber : std::uint8_t { kUnsigned, kSigned, kFloat, kBool };

/// Layout of one message member in CDR.
struct CdrField {
  std::string_view name;
  std::uint8_t size = 0;  ///< of a primitive and its alignment, bytes; 0: not a primitive
  CdrNumber number = CdrNumber::kUnsigned;
  bool is_string = false;
  const CdrLayout* nested = nullptr;  ///< of a message member
  std::uint32_t array_size = 1;       ///< elements of a fixed-size array
  bool is_array = false;              ///< true also for an array of one element
  bool is_sequence = false;           ///< preceded by its number of elements
};

/// The members of a message in serialisation order.
struct CdrLayout {
  std::span<const CdrField> fields;
};

}  // namespace panvo::interfaces
