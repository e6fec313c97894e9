// SPDX-License-Identifier: Apache-2.0
#include "store_schema.hpp"

#include <cerrno>

#include "panvo/landmarks/landmark_store.hpp"
#include "panvo/sqlite/file_header.hpp"

namespace panvo::landmarks {
namespace {

namespace fs = std::filesystem;
using sqlite::Database;
using sqlite::DatabaseError;
using sqlite::Statement;

// The file is complete between commits and can be copied; with a write-ahead log the newest landmarks would be in a
// second file. There is one landmark every ten seconds or so, so each gets a synchronous commit of its own.
constexpr const char* kDurable = "PRAGMA journal_mode=DELETE; PRAGMA synchronous=FULL;";
constexpr const char* kCareful = "PRAGMA trusted_schema=OFF; PRAGMA cell_size_check=ON;";

// Keypoints and thumbnails are in separate tables, so that reading the other columns touches few pages.
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

// Stores of earlier versions get this table with the first pass that is counted. Those versions ignore it.
constexpr const char* kUses = R"(
CREATE TABLE IF NOT EXISTS landmark_use(
  landmark_id INTEGER PRIMARY KEY, passes INTEGER NOT NULL, recognitions INTEGER NOT NULL, missed INTEGER NOT NULL,
  missed_in_company INTEGER NOT NULL, session INTEGER NOT NULL DEFAULT 0);
)";

// The same holds for these, which come with the first change of a live run.
constexpr const char* kRuns = R"(
CREATE TABLE IF NOT EXISTS run(
  id TEXT PRIMARY KEY NOT NULL, session INTEGER NOT NULL, last_id INTEGER NOT NULL) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS run_landmark(
  run TEXT NOT NULL, id_in_run INTEGER NOT NULL, landmark_id INTEGER NOT NULL, PRIMARY KEY(run, id_in_run)) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS run_missed(
  run TEXT NOT NULL, landmark_id INTEGER NOT NULL, missed INTEGER NOT NULL, PRIMARY KEY(run, landmark_id)) WITHOUT ROWID;
)";

/// "truncated after ... of ... bytes" if the file is shorter than its header states; else empty. Uses SQLite's file
/// handle: closing a second descriptor of the file would release all its locks (POSIX).
std::string cut_off(const Database& database) {
  sqlite3_file* file = nullptr;
  sqlite::FileHeader header{};
  sqlite3_int64 size = 0;
  if (sqlite3_file_control(database.handle(), "main", SQLITE_FCNTL_FILE_POINTER, &file) != SQLITE_OK || !file ||
      !file->pMethods || file->pMethods->xFileSize(file, &size) != SQLITE_OK ||
      size < static_cast<sqlite3_int64>(header.size()) ||
      file->pMethods->xRead(file, header.data(), static_cast<int>(header.size()), 0) != SQLITE_OK) {
    return "";
  }
  const auto expected = sqlite::stated_bytes(header);
  if (static_cast<std::uint64_t>(size) >= expected) return "";
  return "truncated after " + std::to_string(size) + " of " + std::to_string(expected) + " bytes";
}

std::string damaged(const fs::path& file, const std::string& how) {
  return file.string() + ": is damaged: " + how + "; restore a copy, or start a new file";
}

void check_kind(const fs::path& file) {
  if (fs::is_directory(file)) throw StoreError(file.string() + ": is a folder; name a landmark store file");
}

bool needs_rollback(const DatabaseError& error) {
  return error.primary_code() == SQLITE_READONLY || error.primary_code() == SQLITE_CANTOPEN;
}

/// Opens and reads a little, as SQLite opens files lazily. Throws DatabaseError, or StoreError for a damaged file.
std::unique_ptr<Database> open(const fs::path& file, Database::Mode mode) {
  auto database = std::make_unique<Database>(file, mode);
  database->wait_for_locks(LandmarkStore::kBusy_ms);
  database->execute(kCareful);
  try {
    database->execute("BEGIN");
    Statement(*database, "SELECT count(*) FROM sqlite_master").step();
  } catch (const DatabaseError& error) {
    if (error.primary_code() != SQLITE_CORRUPT) throw;
    throw_explained(file, error, database.get());
  }
  // No other process can write at this point. SQLite itself would pad a truncated last page with zeros.
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
      return name + "is locked by another process (waited " + std::to_string(LandmarkStore::kBusy_ms / 1000) +
             " s); end that process (a run, a database browser) or use another file";
    case SQLITE_NOTADB:
      return name + "is not a landmark store, or its header is damaged; name another file or restore a copy";
    case SQLITE_CORRUPT: {
      const auto cut = database ? cut_off(*database) : std::string();
      return damaged(file, cut.empty() ? what : cut);
    }
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return name + "is write-protected (" + what + "); make it writable, or use a copy in a writable folder";
    case SQLITE_FULL:
      return name + "cannot be written (" + what + "); free disk space. Earlier landmarks are intact";
    case SQLITE_CANTOPEN:  // SQLite tries several ways, so errno belongs to the last one
      return name + (fs::exists(fs::absolute(file).parent_path())
                         ? "cannot be opened or created; check the permissions of the file and its folder"
                         : "cannot be created: its folder does not exist; create it first");
    case SQLITE_IOERR:
      if (const int reason = error.system_error(); reason == ENOSPC || reason == EDQUOT || reason == EFBIG) {
        return name + "cannot be written (" + what + "); free disk space. Earlier landmarks are intact";
      }
      return name + "disk error (" + what + "); check the disk, and restore a copy if necessary";
    default:
      return name + what;
  }
}

void throw_explained(const fs::path& file, const DatabaseError& error, const Database* database) {
  const int code = error.primary_code();
  if (code == SQLITE_BUSY || code == SQLITE_LOCKED) throw StoreUnavailable(explain(file, error, database));
  throw StoreError(explain(file, error, database));
}

std::unique_ptr<Database> open_to_read(const fs::path& file) {
  check_kind(file);
  if (!fs::exists(file)) throw StoreError(file.string() + ": does not exist; a run with landmark_store.file makes it");
  try {
    return open(file, Database::Mode::kRead);
  } catch (const DatabaseError& error) {
    if (!needs_rollback(error)) throw_explained(file, error, nullptr);
  }
  // A process was killed while writing: rolling back its transaction requires write access.
  try {
    open(file, Database::Mode::kReadWrite);
    return open(file, Database::Mode::kRead);
  } catch (const DatabaseError& error) {
    throw_explained(file, error, nullptr);
  }
}

std::unique_ptr<Database> open_to_write(const fs::path& file) {
  check_kind(file);
  try {
    auto database = open(file, Database::Mode::kCreate);
    if (database->is_read_only()) {  // SQLite silently falls back to read-only
      throw StoreError(file.string() + ": is write-protected; make it writable, or use a copy in a writable folder");
    }
    database->execute(kDurable);
    return database;
  } catch (const DatabaseError& error) {
    throw_explained(file, error, nullptr);
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

void make_table_of_uses(Database& database) {
  database.execute(kUses);
  Statement session(database, "SELECT 1 FROM pragma_table_info('landmark_use') WHERE name = 'session'");
  if (!session.step()) database.execute("ALTER TABLE landmark_use ADD COLUMN session INTEGER NOT NULL DEFAULT 0");
}

void make_tables_of_runs(Database& database) { database.execute(kRuns); }

void check_layout(const fs::path& file, const Database& database) {
  if (has_no_tables(database)) {
    throw StoreError(file.string() + ": is empty: the process that created it ended before writing; delete it");
  }
  if (pragma(database, "application_id") != LandmarkStore::kApplicationId) {
    throw StoreError(file.string() + ": is a database, but not a landmark store (a bag?); name another file");
  }
  const auto layout = pragma(database, "user_version");
  if (layout != LandmarkStore::kLayout) {
    throw StoreError(file.string() + ": has layout " + std::to_string(layout) + "; this version of panvo reads " +
                     std::to_string(LandmarkStore::kLayout) + ". Use the version that wrote it, or start a new file");
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
