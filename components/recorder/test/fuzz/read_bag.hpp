// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace panvo::recorder::fuzz {

/// Opens the bytes as a bag's file named `name` (its ending counts), reads all of it, and checks it. Whatever they
/// are, this ends with messages or with a BagError, and takes no more memory and time than so many bytes are worth.
/// Returns how many messages there were.
std::size_t read_bag(const std::string& name, const std::uint8_t* data, std::size_t size);

}  // namespace panvo::recorder::fuzz
