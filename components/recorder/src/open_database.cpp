// SPDX-License-Identifier: Apache-2.0
#include "open_database.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "panvo/recorder/bag_error.hpp"
#include "panvo/sqlite/file_header.hpp"
#include "whole_pages_vfs.hpp"

namespace panvo::recorder {
namespace {

namespace fs = std::filesystem;
using sqlite::Database;
using sqlite::DatabaseError;

std::size_t read_header(const fs::path& file, sqlite::FileHeader& header) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    throw BagError(file.string() + ": cannot be opened (" + std::strerror(errno) + ")");
  }
  stream.read(reinterpret_cast<char*>(header.data()), header.size());
  return static_cast<std::size_t>(stream.gcount());
}

/// Size of `file` with `suffix` appended to its name; 0 if it does not exist.
std::uint64_t size_of(fs::path file, const char* suffix) {
  file += suffix;
  std::error_code error;
  const auto size = fs::file_size(file, error);
  return error ? 0 : size;
}

/// Opens the database and reads its schema, since SQLite defers opening until the first read.
Database open_and_look(const fs::path& file, Database::Mode mode) {
  const bool is_cut = mode != Database::Mode::kReadWrite && expected_bytes_if_cut(file) > 0;
  Database database(file, mode, is_cut ? whole_pages_vfs() : nullptr);
  database.limit_steps(size_of(file, "") + size_of(file, "-wal"));
  // writable_schema allows reading a file that is shorter than its header states. The mode prevents writing.
  database.execute("PRAGMA writable_schema=ON; PRAGMA trusted_schema=OFF; PRAGMA cell_size_check=ON;");
  sqlite::Statement(database, "SELECT count(*) FROM sqlite_master").step();
  return database;
}

bool is_damage(const DatabaseError& error) {
  return error.primary_code() == SQLITE_CORRUPT || error.primary_code() == SQLITE_NOTADB;
}

}  // namespace

std::uint64_t expected_bytes_if_cut(const fs::path& file) {
  sqlite::FileHeader header{};
  if (read_header(file, header) < header.size()) {
    return header.size();
  }
  const std::uint64_t expected = sqlite::stated_bytes(header);
  return fs::file_size(file) < expected ? expected : 0;
}

Database open_database(const fs::path& file, std::vector<std::string>& warnings) {
  try {
    return open_and_look(file, Database::Mode::kRead);
  } catch (const DatabaseError& error) {
    if (error.primary_code() == SQLITE_BUSY) {
      throw BagError(file.string() + ": is being written by another program; stop the recording first");
    }
    if (is_damage(error)) {
      throw BagError(file.string() + ": is damaged at its start (" + error.what() + "); nothing in it can be read");
    }
    // Otherwise an unfinished commit must be rolled back or a write-ahead log read; both need write access.
  }
  const bool unfinished = size_of(file, "-journal") > 0 || size_of(file, "-wal") > 0;
  try {
    open_and_look(file, Database::Mode::kReadWrite);
    auto database = open_and_look(file, Database::Mode::kRead);
    if (unfinished) {
      warnings.push_back(file.string() +
                         ": the recorder did not finish its last batch (was it killed?); the file has been repaired");
    }
    return database;
  } catch (const DatabaseError& error) {
    if (is_damage(error)) {
      throw BagError(file.string() + ": is damaged at its start (" + error.what() + "); nothing in it can be read");
    }
    if (unfinished) {
      throw BagError(file.string() + ": has an unfinished batch and is write-protected (" + error.what() +
                     "); copy the bag with all its files to a writable folder and open the copy");
    }
  }
  try {
    return open_and_look(file, Database::Mode::kImmutable);
  } catch (const DatabaseError& error) {
    throw BagError(file.string() + ": cannot be read (" + error.what() + ")");
  }
}

}  // namespace panvo::recorder
