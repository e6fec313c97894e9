// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "panvo/interfaces/message_type.hpp"

namespace panvo::interfaces {

/// A serialised message as YAML, one member per line, as `ros2 topic echo` prints it. Lists and strings with more than
/// `longest` elements or bytes are cut and end in "..."; 0: no limit. Throws DecodeError for bytes that are not a
/// message of this type.
std::string to_yaml(const MessageType& type, std::span<const std::uint8_t> bytes, std::size_t longest = 128);

}  // namespace panvo::interfaces
