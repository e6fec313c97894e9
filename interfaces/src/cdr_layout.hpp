// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string_view>

#include "panvo/interfaces/message_layout.hpp"

namespace panvo::interfaces {

/// Checks that a payload (without encapsulation header) is long enough for its members. Throws DecodeError with type
/// and member if it is not. Call it before decoding: the decoder allocates memory for a length before it checks that
/// the data is there.
void check_cdr(std::string_view type_name, const CdrLayout& layout, std::span<const std::uint8_t> payload,
               std::endian order);

}  // namespace panvo::interfaces
