// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "database.hpp"

namespace panvo::recorder {

/// How a bag that is stored in another way than SQLite is made readable.
std::string how_to_convert(const std::filesystem::path& bag);

/// Opens a .db3 file for reading, so that a file that is cut off opens too. A recorder's unfinished last commit is
/// rolled back. Throws BagError naming file and remedy: missing, not a database, compressed, MCAP, being written.
Database open_database(const std::filesystem::path& file, std::vector<std::string>& warnings);

/// How many bytes the file should have by its own header when it has fewer; 0 when nothing is missing.
std::uint64_t expected_bytes_if_cut(const std::filesystem::path& file);

}  // namespace panvo::recorder
