// SPDX-License-Identifier: Apache-2.0
#include "saved_copy.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "panvo/landmarks/landmark_store.hpp"
#include "panvo/landmarks/store_error.hpp"
#include "panvo/sqlite/database.hpp"
#include "store_schema.hpp"
#include "unfinished_file.hpp"

namespace panvo::landmarks {
namespace {

namespace fs = std::filesystem;

/// SQLite knows the calendar.
fs::path name_of_copy(const fs::path& file, const sqlite::Database& database, std::int64_t time_ns) {
  sqlite::Statement text(database, "SELECT strftime('_%Y%m%dT%H%M%SZ', ?, 'unixepoch')");
  text.bind(1, time_ns / 1'000'000'000).step();
  return file.parent_path() / (file.stem().string() + text.text(0) + file.extension().string());
}

/// SQLite has closed the file, so that no lock is lost with this descriptor.
void sync(const fs::path& file, const fs::path& named) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
  const bool is_on_disk = descriptor >= 0 && ::fsync(descriptor) == 0;
  const std::error_code error(errno, std::generic_category());
  if (descriptor >= 0) ::close(descriptor);
  if (!is_on_disk) throw StoreError(named.string() + ": cannot be written (" + error.message() + ")");
}

}  // namespace

SavedCopy save_beside(const fs::path& file, std::int64_t time_ns) {
  const auto source = open_to_read(file);
  check_layout(file, *source);
  SavedCopy copy{name_of_copy(file, *source, time_ns), 0};
  if (fs::exists(copy.file)) throw StoreError(copy.file.string() + ": already exists; save again in a second");
  UnfinishedFile unfinished(copy.file);
  try {
    // Reads one state, and is twice as fast as SQLite's backup of pages.
    sqlite::Statement(*source, "VACUUM INTO ?").bind(1, unfinished.path().native()).run();
  } catch (const sqlite::DatabaseError& error) {
    // Names the copy if it cannot be written, else the store.
    const bool is_of_copy = error.primary_code() != SQLITE_CORRUPT && error.primary_code() != SQLITE_BUSY;
    throw_explained(is_of_copy ? copy.file : file, error, source.get());
  }
  copy.landmarks = LandmarkStore(unfinished.path()).size();
  sync(unfinished.path(), copy.file);
  unfinished.finish_new();
  return copy;
}

}  // namespace panvo::landmarks
