// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "bag_file_reader.hpp"
#include "database.hpp"

namespace panvo::recorder {

struct Salvaged {
  std::vector<BagFileReader::Entry> entries;  ///< every message that can be read whole, in order of timestamp, then id
  std::uint64_t missing_ids = 0;              ///< gaps between them; how many followed the last one nobody knows
};

/// Reads through a damaged table of messages by id, leaping over what cannot be read: one stretch of damage after
/// another is passed, readable messages in the midst of one may be missed. Reads all data once.
Salvaged salvage_messages(const Database& database);

}  // namespace panvo::recorder
