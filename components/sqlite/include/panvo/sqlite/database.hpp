// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace panvo::sqlite {

/// Error of an SQLite call: its extended result code, and errno if the operating system caused it (otherwise 0).
class DatabaseError : public std::runtime_error {
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
    kCreate,  ///< read and write; creates the file if it does not exist
    kReadWrite,
    kRead,
    kImmutable,  ///< read-only, assuming no writer: no locks, journals ignored
  };

  /// `vfs`: name of the SQLite VFS; nullptr: the default.
  Database(const std::filesystem::path& file, Mode mode, const char* vfs = nullptr);

  /// Sets the longest wait for another process's lock, after which a call throws. Initially 0.
  void wait_for_locks(int limit_ms) noexcept { sqlite3_busy_timeout(handle_.get(), limit_ms); }

  /// For untrusted files: limits the steps of each statement in proportion to the file size `bytes`. Otherwise a b-tree
  /// whose branches share pages could be walked for years.
  void limit_steps(std::uint64_t bytes);

  /// Runs statements and discards their results.
  void execute(const std::string& sql);

  bool is_read_only() const noexcept { return sqlite3_db_readonly(handle_.get(), "main") == 1; }
  bool in_transaction() const noexcept { return sqlite3_get_autocommit(handle_.get()) == 0; }
  sqlite3* handle() const noexcept { return handle_.get(); }

 private:
  friend class Statement;

  /// In calls of SQLite's progress handler, which come at equal numbers of steps.
  struct StepLimit {
    std::uint64_t max_calls = 0;
    std::uint64_t* spent = nullptr;  ///< calls spent by the running statement
  };
  struct Close {
    void operator()(sqlite3* database) const noexcept { sqlite3_close_v2(database); }
  };
  std::unique_ptr<StepLimit> step_limit_;  // before the handle, which refers to it; nullptr: no limit
  std::unique_ptr<sqlite3, Close> handle_;
};

/// Begins a transaction that locks out other writers. Rolls back unless commit() was called.
class Transaction {
 public:
  explicit Transaction(Database& database);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;

  void commit();

 private:
  Database& database_;
  bool is_open_ = true;
};

/// A prepared statement. Parameters count from 1, columns from 0, as in SQLite. Its functions throw DatabaseError.
class Statement {
 public:
  Statement(const Database& database, std::string_view sql);

  Statement& bind(int parameter, std::int64_t value);
  Statement& bind(int parameter, double value);
  Statement& bind(int parameter, std::string_view value);
  /// Does not copy: the bytes must remain valid until the statement is reset.
  Statement& bind(int parameter, std::span<const std::uint8_t> value);
  /// Binds a value of another statement's current row.
  Statement& bind(int parameter, const Statement& row, int column);

  bool step();  ///< returns whether there is a row
  void reset() noexcept;
  void run();  ///< steps to the end and resets

  int columns() const noexcept { return sqlite3_column_count(handle_.get()); }
  std::int64_t integer(int column) const noexcept { return sqlite3_column_int64(handle_.get(), column); }
  double real(int column) const noexcept { return sqlite3_column_double(handle_.get(), column); }
  std::string text(int column) const;
  /// Does not copy: valid until the next step() or reset().
  std::span<const std::uint8_t> blob(int column) const;

 private:
  void check(int result) const;

  struct Finalize {
    void operator()(sqlite3_stmt* statement) const noexcept { sqlite3_finalize(statement); }
  };
  sqlite3* database_;
  Database::StepLimit* step_limit_;
  std::uint64_t spent_ = 0;  // since the last reset()
  std::unique_ptr<sqlite3_stmt, Finalize> handle_;
};

}  // namespace panvo::sqlite
