// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "bag_file_reader.hpp"
#include "panvo/sqlite/database.hpp"

namespace panvo::recorder {

struct Salvaged {
  std::vector<BagFileReader::Entry> entries;  ///< completely readable messages, ordered by timestamp, then id
  std::uint64_t missing_ids = 0;              ///< ids missing between them; losses after the last one are unknown
};

/// Reads a damaged messages table by id and skips unreadable ranges. Readable messages within such a range may be
/// missed. Reads all data once.
Salvaged salvage_messages(const sqlite::Database& database);

}  // namespace panvo::recorder
