// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "panvo/interfaces/message_type.hpp"

namespace panvo::interfaces {

/// How the bytes of a primitive are to be understood.
enum class CdrNumber : std::uint8_t { kUnsigned, kSigned, kFloat, kBool };

/// How one member of a message lies in CDR bytes.
struct CdrField {
  std::string_view name;
  std::uint8_t size = 0;  ///< of a primitive, which is also its alignment
  CdrNumber number = CdrNumber::kUnsigned;
  bool is_string = false;
  const CdrLayout* nested = nullptr;  ///< of a member that is a message
  std::uint32_t array_size = 1;       ///< elements of a fixed array
  bool is_array = false;              ///< of one element too
  bool is_sequence = false;           ///< led by the number of its elements
};

/// The members of a message, in the order of their bytes.
struct CdrLayout {
  std::span<const CdrField> fields;
};

}  // namespace panvo::interfaces
