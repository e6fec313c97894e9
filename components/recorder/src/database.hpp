// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "storage_error.hpp"

namespace panvo::recorder {

/// An SQLite error: its extended result code, and errno if the operating system caused it (otherwise 0).
class DatabaseError : public StorageError {
 public:
  DatabaseError(sqlite3* database, int result);

  int code() const noexcept { return code_; }
  int primary_code() const noexcept { return code_ & 0xff; }
  int system_error() const noexcept { return system_error_; }

 private:
  int code_;
  int system_error_;
};

/// An open SQLite database. Its functions throw DatabaseError.
class Database {
 public:
  enum class Mode {
    kCreate,  ///< must not exist
    kReadWrite,
    kRead,
    kImmutable,  ///< read-only, assuming no writer: no locks, journals ignored
  };

  /// `vfs`: name of the SQLite VFS; nullptr: the default.
  Database(const std::filesystem::path& file, Mode mode, const char* vfs = nullptr);

  /// For untrusted files: limits the steps of each statement in proportion to the file size `bytes`. Otherwise a b-tree
  /// whose branches share pages could be walked for years.
  void inflate_covariance(std::uint64_t bytes);

  /// Runs statements and discards their results.
  void execute(const std::string& sql);

  std::int64_t last_insert_id() const noexcept { return sqlite3_last_insert_rowid(handle_.get()); }
  bool in_transaction() const noexcept { return sqlite3_get_autocommit(handle_.get()) == 0; }
  sqlite3* handle() const noexcept { return handle_.get(); }

  /// Time limit of a statement, in calls of SQLite's progress handler.
  struct Patience {
    std::uint64_t most = 0;
    std::uint64_t* spent = nullptr;  ///< calls spent by the running statement
  };
  Patience* patience() const noexcept { return patience_.get(); }  ///< nullptr: no limit

 private:
  struct Close {
    void operator()(sqlite3* database) const noexcept { sqlite3_close_v2(database); }
  };
  std::unique_ptr<Patience> patience_;  // before the handle, which refers to it
  std::unique_ptr<sqlite3, Close> handle_;
};

/// A prepared statement. Parameters count from 1, columns from 0, as in SQLite.
class Statement {
 public:
  Statement(const Database& database, std::string_view sql);

  Statement& bind(int parameter, std::int64_t value);
  Statement& bind(int parameter, std::string_view value);
  /// The bytes must remain valid until the statement is reset.
  Statement& bind(int parameter, std::span<const std::uint8_t> value);

  bool step();  ///< returns whether there is a row
  void reset() noexcept;
  void run();  ///< steps to the end and resets

  std::int64_t integer(int column) const noexcept { return sqlite3_column_int64(handle_.get(), column); }
  std::string text(int column) const;
  bool is_null(int column) const noexcept { return sqlite3_column_type(handle_.get(), column) == SQLITE_NULL; }
  /// Valid until the next step().
  std::span<const std::uint8_t> blob(int column) const;

 private:
  void check(int result) const;

  struct Finalize {
    void operator()(sqlite3_stmt* statement) const noexcept { sqlite3_finalize(statement); }
  };
  sqlite3* database_;
  Database::Patience* patience_;
  std::uint64_t spent_ = 0;  // since the last reset()
  std::unique_ptr<sqlite3_stmt, Finalize> handle_;
};

}  // namespace panvo::recorder
