// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace panvo::recorder::fuzz {

/// Mutates bytes to at most `limit` bytes, e.g. libFuzzer's mutator.
using Mutate = std::function<std::string(std::string bytes, std::size_t limit)>;

/// Damages one record of an MCAP file, possibly inside an uncompressed chunk. Corrects the enclosing lengths and clears
/// the checksums, so that a reader parses the damaged record instead of rejecting the checksum.
std::string mutate_record(std::string file, std::uint64_t seed, const Mutate& mutate);

}  // namespace panvo::recorder::fuzz
