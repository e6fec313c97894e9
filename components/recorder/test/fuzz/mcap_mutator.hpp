// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace panvo::recorder::fuzz {

/// Changes bytes in place, to at most `limit`: libFuzzer's own mutator.
using Mutate = std::function<std::string(std::string bytes, std::size_t limit)>;

/// Damages one record of an MCAP file, those within uncompressed chunks too, and mends the lengths around it and takes
/// the checksums away, so that a reader comes to see the damage and not only that there is some.
std::string mutate_record(std::string file, std::uint64_t seed, const Mutate& mutate);

}  // namespace panvo::recorder::fuzz
