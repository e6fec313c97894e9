// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "panvo/interfaces/message_type.hpp"

namespace panvo::interfaces {

/// A serialised message as YAML, a member a line, as `ros2 topic echo` shows it. Of lists and texts that are longer than `longest`, the beginning
/// and "..."; 0: all. Throws DecodeError for bytes that are no such message.
std::string to_yaml(const MessageType& type, std::span<const std::uint8_t> bytes, std::size_t longest = 128);

}  // namespace panvo::interfaces
