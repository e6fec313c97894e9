// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "database.hpp"

namespace panvo::recorder {

/// Opens a .db3 file for reading, so that a file that is cut off opens too. A recorder's unfinished last commit is
/// rolled back. Throws BagError naming file and remedy: damaged at its start, being written.
Database open_database(const std::filesystem::path& file, std::vector<std::string>& warnings);

/// How many bytes the file should have by its own header when it has fewer; 0 when nothing is missing.
std::uint64_t expected_bytes_if_cut(const std::filesystem::path& file);

}  // namespace panvo::recorder
