// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace panvo::recorder::fuzz {

/// Opens the bytes as a bag file named `name` (the extension matters), reads all messages and checks it. Any input must
/// give messages or a BagError, with time and memory proportional to its size. Returns the number of messages.
std::size_t read_bag(const std::string& name, const std::uint8_t* data, std::size_t size);

}  // namespace panvo::recorder::fuzz
