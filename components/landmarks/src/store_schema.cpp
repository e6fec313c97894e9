// SPDX-License-Identifier: Apache-2.0
#include "store_schema.hpp"

#include <array>
#include <cerrno>
#include <string_view>

#include "panvo/landmarks/landmark_store.hpp"

namespace panvo::landmarks {
namespace {

namespace fs = std::filesystem;

// Between commits the file is complete by itself and can be copied; a write-ahead log would keep the newest landmarks in
// a second file. Each landmark is worth a commit of its own that reaches the disk: one comes every ten seconds or so.
constexpr const char* kDurable = "PRAGMA journal_mode=DELETE; PRAGMA synchronous=FULL;";
constexpr const char* kCareful = "PRAGMA trusted_schema=OFF; PRAGMA cell_size_check=ON;";

// Keypoints and thumbnails lie apart, so that reading all the rest passes over few pages.
constexpr const char* kTables = R"(
CREATE TABLE meta(key TEXT PRIMARY KEY NOT NULL, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE landmark(
  id INTEGER PRIMARY KEY, stamp_ns INTEGER NOT NULL, is_junction INTEGER NOT NULL,
  x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL,
  qx REAL NOT NULL, qy REAL NOT NULL, qz REAL NOT NULL, qw REAL NOT NULL,
  covariance BLOB NOT NULL,
  panorama_x REAL NOT NULL, panorama_y REAL NOT NULL, panorama_z REAL NOT NULL,
  panorama_qx REAL NOT NULL, panorama_qy REAL NOT NULL, panorama_qz REAL NOT NULL, panorama_qw REAL NOT NULL,
  histogram BLOB NOT NULL, large_features BLOB NOT NULL, small_features BLOB NOT NULL);
CREATE TABLE keypoints(landmark_id INTEGER PRIMARY KEY, count INTEGER NOT NULL, data BLOB NOT NULL);
CREATE TABLE thumbnail(landmark_id INTEGER PRIMARY KEY, jpeg BLOB NOT NULL);
)";

/// "it is cut off after ... of ... bytes", where the file is shorter than its own header says; else empty. Asks SQLite's file:
/// opening the file a second time would lose all locks on it when it is closed (POSIX).
std::string cut_off(const Database& database) {
  sqlite3_file* file = nullptr;
  std::array<unsigned char, 100> header{};  // at 16 the size of a page, at 28 the number of pages, big-endian
  sqlite3_int64 size = 0;
  if (sqlite3_file_control(database.handle(), "main", SQLITE_FCNTL_FILE_POINTER, &file) != SQLITE_OK || !file ||
      !file->pMethods || file->pMethods->xFileSize(file, &size) != SQLITE_OK ||
      size < static_cast<sqlite3_int64>(header.size()) ||
      file->pMethods->xRead(file, header.data(), static_cast<int>(header.size()), 0) != SQLITE_OK) {
    return "";
  }
  const int page = header[16] << 8 | header[17];
  sqlite3_int64 pages = 0;
  for (std::size_t i = 28; i < 32; ++i) pages = pages << 8 | header[i];
  const auto expected = (page == 1 ? 65536 : page) * pages;
  if (size >= expected) return "";
  return "it is cut off after " + std::to_string(size) + " of " + std::to_string(expected) + " bytes";
}

std::string damaged(const fs::path& file, const std::string& how) {
  return file.string() + ": is damaged: " + how + "; go back to a copy of it, or begin a new file";
}

void check_kind(const fs::path& file) {
  if (fs::is_directory(file)) throw StoreError(file.string() + ": is a folder; name a file for the landmarks");
}

bool needs_rollback(const DatabaseError& error) {
  return error.primary_code() == SQLITE_READONLY || error.primary_code() == SQLITE_CANTOPEN;
}

/// Opens and reads a little, as SQLite opens nothing before it has to. Throws DatabaseError, StoreError for a damaged file.
std::unique_ptr<Database> open(const fs::path& file, Database::Mode mode) {
  auto database = std::make_unique<Database>(file, mode, LandmarkStore::kBusy_ms);
  database->execute(kCareful);
  try {
    database->execute("BEGIN");
    Statement(*database, "SELECT count(*) FROM sqlite_master").step();
  } catch (const DatabaseError& error) {
    if (error.primary_code() != SQLITE_CORRUPT) throw;
    throw StoreError(explain(file, error, database.get()));
  }
  // Here nobody else writes. SQLite itself would fill up a last page that is cut with zeros.
  if (const auto cut = cut_off(*database); !cut.empty()) throw StoreError(damaged(file, cut));
  database->execute("COMMIT");
  return database;
}

std::int64_t pragma(const Database& database, const char* name) {
  Statement statement(database, std::string("PRAGMA ") + name);
  return statement.step() ? statement.integer(0) : 0;
}

}  // namespace

std::string explain(const fs::path& file, const DatabaseError& error, const Database* database) {
  const std::string name = file.string() + ": ";
  const std::string what = error.what();
  switch (error.primary_code()) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return name + "is locked by another process, and was for " + std::to_string(LandmarkStore::kBusy_ms / 1000) +
             " s; end the one that uses it (a run, a database browser), or use another file";
    case SQLITE_NOTADB:
      return name + "is no landmark store (or its first bytes are damaged); name another file, or a copy of it";
    case SQLITE_CORRUPT: {
      const auto cut = database ? cut_off(*database) : std::string();
      return damaged(file, cut.empty() ? what : cut);
    }
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return name + "is write-protected (" + what +
             "); let it be written to, or copy it to where you may write and use the copy";
    case SQLITE_FULL:
      return name + "cannot be written (" + what + "); free some space. All landmarks added before are there";
    case SQLITE_CANTOPEN:  // SQLite tries several ways, and errno is that of the last
      return name + (fs::exists(fs::absolute(file).parent_path())
                         ? "cannot be opened or made; check that you may use it, and write in its folder"
                         : "cannot be made: there is no such folder; make it first");
    case SQLITE_IOERR:
      if (const int reason = error.system_error(); reason == ENOSPC || reason == EDQUOT || reason == EFBIG) {
        return name + "cannot be written (" + what + "); free some space. All landmarks added before are there";
      }
      return name + "the disk failed (" + what + "); check it, and go back to a copy if need be";
    default:
      return name + what;
  }
}

std::unique_ptr<Database> open_to_read(const fs::path& file) {
  check_kind(file);
  if (!fs::exists(file)) throw StoreError(file.string() + ": does not exist; a run with landmarks makes one");
  try {
    return open(file, Database::Mode::kRead);
  } catch (const DatabaseError& error) {
    if (!needs_rollback(error)) throw StoreError(explain(file, error, nullptr));
  }
  // A process was killed while it wrote: taking its part back needs to write.
  try {
    open(file, Database::Mode::kReadWrite);
    return open(file, Database::Mode::kRead);
  } catch (const DatabaseError& error) {
    throw StoreError(explain(file, error, nullptr));
  }
}

std::unique_ptr<Database> open_to_write(const fs::path& file) {
  check_kind(file);
  try {
    auto database = open(file, Database::Mode::kCreateOrReadWrite);
    if (database->is_read_only()) {  // SQLite falls back to reading without a word
      throw StoreError(
          file.string() +
          ": is write-protected; let it be written to, or copy it to where you may write and use the copy");
    }
    database->execute(kDurable);
    return database;
  } catch (const DatabaseError& error) {
    throw StoreError(explain(file, error, nullptr));
  }
}

bool has_no_tables(const Database& database) {
  Statement statement(database, "SELECT count(*) FROM sqlite_master");
  return statement.step() && statement.integer(0) == 0;
}

void make_tables(Database& database) {
  database.execute(kTables);
  database.execute("PRAGMA application_id=" + std::to_string(LandmarkStore::kApplicationId) +
                   "; PRAGMA user_version=" + std::to_string(LandmarkStore::kLayout));
}

void check_layout(const fs::path& file, const Database& database) {
  if (has_no_tables(database)) {
    throw StoreError(file.string() + ": is empty: whoever made it was ended before it had begun; delete it");
  }
  if (pragma(database, "application_id") != LandmarkStore::kApplicationId) {
    throw StoreError(file.string() + ": is a database, but no landmark store (a bag?); name another file");
  }
  const auto layout = pragma(database, "user_version");
  if (layout != LandmarkStore::kLayout) {
    throw StoreError(file.string() + ": is of layout " + std::to_string(layout) + ", and this panvo reads layout " +
                     std::to_string(LandmarkStore::kLayout) + "; use the panvo that made it, or begin a new file");
  }
}

std::string damage_of(const Database& database) {
  Statement statement(database, "PRAGMA quick_check(3)");
  std::string found;
  while (statement.step()) {
    const auto line = statement.text(0);
    if (line != "ok") found += (found.empty() ? "" : "; ") + line;
  }
  return found;
}

}  // namespace panvo::landmarks
