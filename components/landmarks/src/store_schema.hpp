// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "database.hpp"

/// The file behind a landmark store: how it is opened, laid out and what its errors mean.
namespace panvo::landmarks {

/// What SQLite refused, as a message that names file and remedy. `database`: the one that refused, if it was open.
std::string explain(const std::filesystem::path& file, const DatabaseError& error, const Database* database);

/// Opens a store that exists to read it. A last addition that a killed process left half written is taken back.
/// Throws StoreError.
std::unique_ptr<Database> open_to_read(const std::filesystem::path& file);

/// Opens a store to write to it; makes the file if there is none. Its tables are made by make_tables(). Throws StoreError.
std::unique_ptr<Database> open_to_write(const std::filesystem::path& file);

bool has_no_tables(const Database& database);
/// Throws DatabaseError.
void make_tables(Database& database);
/// Throws StoreError for a database that is no landmark store, or one of another layout.
void check_layout(const std::filesystem::path& file, const Database& database);

/// What SQLite's own check finds; empty when that is nothing. Reads all of the file.
std::string damage_of(const Database& database);

}  // namespace panvo::landmarks
