// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "panvo/sqlite/database.hpp"

namespace panvo::recorder {

/// Opens a .db3 file for reading, also if it is truncated. Rolls back a recorder's unfinished last commit. Throws
/// BagError with file and remedy, e.g. if the file is damaged at its start or being written.
sqlite::Database open_database(const std::filesystem::path& file, std::vector<std::string>& warnings);

/// Returns the size that the header gives if the file is shorter than that, otherwise 0.
std::uint64_t expected_bytes_if_cut(const std::filesystem::path& file);

}  // namespace panvo::recorder
