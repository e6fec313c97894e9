// SPDX-License-Identifier: Apache-2.0
#include "database.hpp"

#include <cerrno>
#include <cstring>

namespace panvo::landmarks {
namespace {

/// Operating-system error of the failed call. After a failed commit SQLite no longer has it, but errno does, as it is
/// cleared before each call.
int system_error_of(sqlite3* database) {
  const int known = database ? sqlite3_system_errno(database) : 0;
  return known != 0 ? known : errno;
}

std::string describe(sqlite3* database, int result) {
  const int error = system_error_of(database);
  const int primary = result & 0xff;
  if (error != 0 && (primary == SQLITE_IOERR || primary == SQLITE_FULL || primary == SQLITE_CANTOPEN)) {
    return std::strerror(error);
  }
  return database ? sqlite3_errmsg(database) : sqlite3_errstr(result);
}

int flags(Database::Mode mode) {
  switch (mode) {
    case Database::Mode::kRead:
      return SQLITE_OPEN_READONLY | SQLITE_OPEN_NOMUTEX;
    case Database::Mode::kReadWrite:
      return SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX;
    case Database::Mode::kCreateOrReadWrite:
      break;
  }
  return SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX;
}

}  // namespace

DatabaseError::DatabaseError(sqlite3* database, int result)
    : std::runtime_error(describe(database, result)),
      code_(database ? sqlite3_extended_errcode(database) : result),
      system_error_(system_error_of(database)) {}

Database::Database(const std::filesystem::path& file, Mode mode, int busy_ms) {
  sqlite3* database = nullptr;
  errno = 0;
  const int result = sqlite3_open_v2(file.c_str(), &database, flags(mode), nullptr);
  handle_.reset(database);  // a handle that failed to open must be closed as well
  if (result != SQLITE_OK) throw DatabaseError(database, result);
  sqlite3_extended_result_codes(database, 1);
  sqlite3_busy_timeout(database, busy_ms);
}

void Database::execute(const std::string& sql) {
  errno = 0;
  const int result = sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (result != SQLITE_OK) throw DatabaseError(handle_.get(), result);
}

Transaction::Transaction(Database& database) : database_(database) { database_.execute("BEGIN IMMEDIATE"); }

Transaction::~Transaction() {
  // A failed write may have rolled back already; failures here are ignored.
  if (is_open_) sqlite3_exec(database_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
}

void Transaction::commit() {
  database_.execute("COMMIT");
  is_open_ = false;
}

Statement::Statement(const Database& database, std::string_view sql) : database_(database.handle()) {
  sqlite3_stmt* statement = nullptr;
  check(sqlite3_prepare_v2(database_, sql.data(), static_cast<int>(sql.size()), &statement, nullptr));
  handle_.reset(statement);
}

Statement& Statement::bind(int parameter, std::int64_t value) {
  check(sqlite3_bind_int64(handle_.get(), parameter, value));
  return *this;
}

Statement& Statement::bind(int parameter, double value) {
  check(sqlite3_bind_double(handle_.get(), parameter, value));
  return *this;
}

Statement& Statement::bind(int parameter, std::string_view value) {
  // An empty view may have a null address, which SQLite would store as NULL.
  const char* text = value.data() ? value.data() : "";
  check(sqlite3_bind_text64(handle_.get(), parameter, text, value.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
  return *this;
}

Statement& Statement::bind(int parameter, std::span<const std::uint8_t> value) {
  check(value.empty() ? sqlite3_bind_zeroblob(handle_.get(), parameter, 0)
                      : sqlite3_bind_blob64(handle_.get(), parameter, value.data(), value.size(), SQLITE_STATIC));
  return *this;
}

Statement& Statement::bind(int parameter, const Statement& row, int column) {
  check(sqlite3_bind_value(handle_.get(), parameter, sqlite3_column_value(row.handle_.get(), column)));
  return *this;
}

bool Statement::step() {
  errno = 0;
  const int result = sqlite3_step(handle_.get());
  if (result != SQLITE_ROW && result != SQLITE_DONE) throw DatabaseError(database_, result);
  return result == SQLITE_ROW;
}

void Statement::run() {
  try {
    while (step()) {
    }
  } catch (const DatabaseError&) {
    sqlite3_reset(handle_.get());
    throw;
  }
  sqlite3_reset(handle_.get());
}

std::string Statement::text(int column) const {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(handle_.get(), column));
  return text ? std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(handle_.get(), column)))
              : std::string();
}

std::span<const std::uint8_t> Statement::blob(int column) const {
  const auto* data = static_cast<const std::uint8_t*>(sqlite3_column_blob(handle_.get(), column));
  return {data, data ? static_cast<std::size_t>(sqlite3_column_bytes(handle_.get(), column)) : 0};
}

void Statement::check(int result) const {
  if (result != SQLITE_OK) throw DatabaseError(database_, result);
}

}  // namespace panvo::landmarks
