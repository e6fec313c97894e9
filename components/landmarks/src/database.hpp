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

namespace panvo::landmarks {

/// Error of a SQLite call: its result code, and errno if the operating system caused it (else 0).
class DatabaseError : public std::runtime_error {
 public:
  DatabaseError(sqlite3* database, int result);

  int primary_code() const noexcept { return code_ & 0xff; }
  int system_error() const noexcept { return system_error_; }

 private:
  int code_;
  int system_error_;
};

/// An open SQLite database. All member functions may throw DatabaseError.
class Database {
 public:
  enum class Mode { kRead, kReadWrite, kCreateOrReadWrite };

  /// Waits up to `busy_ms` for another process's lock, then throws.
  Database(const std::filesystem::path& file, Mode mode, int busy_ms);

  void execute(const std::string& sql);
  bool is_read_only() const noexcept { return sqlite3_db_readonly(handle_.get(), "main") == 1; }
  sqlite3* handle() const noexcept { return handle_.get(); }

 private:
  struct Close {
    void operator()(sqlite3* database) const noexcept { sqlite3_close_v2(database); }
  };
  std::unique_ptr<sqlite3, Close> handle_;
};

/// Rolls back unless commit() was called.
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

/// A prepared statement. Parameters count from 1, columns from 0, as in SQLite.
class Statement {
 public:
  Statement(const Database& database, std::string_view sql);

  Statement& bind(int parameter, std::int64_t value);
  Statement& bind(int parameter, double value);
  Statement& bind(int parameter, std::string_view value);
  /// The bytes must stay valid until the statement is reset.
  Statement& bind(int parameter, std::span<const std::uint8_t> value);

  /// Binds a value of another statement's current row; it must stay valid until this statement has run.
  Statement& bind(int parameter, const Statement& row, int column);

  bool step();  ///< returns whether there is a row
  void run();   ///< steps to the end and resets

  int columns() const noexcept { return sqlite3_column_count(handle_.get()); }
  std::int64_t integer(int column) const noexcept { return sqlite3_column_int64(handle_.get(), column); }
  double real(int column) const noexcept { return sqlite3_column_double(handle_.get(), column); }
  std::string text(int column) const;
  /// Valid until the next step().
  std::span<const std::uint8_t> blob(int column) const;

 private:
  void check(int result) const;

  struct Finalize {
    void operator()(sqlite3_stmt* statement) const noexcept { sqlite3_finalize(statement); }
  };
  sqlite3* database_;
  std::unique_ptr<sqlite3_stmt, Finalize> handle_;
};

}  // namespace panvo::landmarks
