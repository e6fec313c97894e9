// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "panvo/sqlite/database.hpp"

/// The SQLite file of a landmark store: opening, schema and error messages.
namespace panvo::landmarks {

/// Turns an SQLite error into a message with file and remedy. `database`: the one that failed, if it was open.
std::string explain(const std::filesystem::path& file, const sqlite::DatabaseError& error,
                    const sqlite::Database* database);
/// Throws a StoreError that tells an SQLite error like this: StoreUnavailable for a lock of another process.
[[noreturn]] void throw_explained(const std::filesystem::path& file, const sqlite::DatabaseError& error,
                                  const sqlite::Database* database);

/// Opens an existing store read-only. Rolls back a partial addition of a killed process. Throws StoreError.
std::unique_ptr<sqlite::Database> open_to_read(const std::filesystem::path& file);

/// Opens a store for writing; creates the file, without tables (see make_tables()). Throws StoreError.
std::unique_ptr<sqlite::Database> open_to_write(const std::filesystem::path& file);

bool has_no_tables(const sqlite::Database& database);
/// Throws DatabaseError.
void make_tables(sqlite::Database& database);
/// Adds the table of uses, unless it is there. Throws DatabaseError.
void make_table_of_uses(sqlite::Database& database);
/// Adds the tables of runs, unless they are there. Throws DatabaseError.
void make_tables_of_runs(sqlite::Database& database);
/// Throws StoreError if the database is not a landmark store or has another layout version.
void check_layout(const std::filesystem::path& file, const sqlite::Database& database);

/// Result of SQLite's own check; empty if it finds nothing. Reads the whole file.
std::string damage_of(const sqlite::Database& database);

}  // namespace panvo::landmarks
