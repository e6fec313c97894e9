// SPDX-License-Identifier: Apache-2.0
#include "database.hpp"

#include <cerrno>
#include <cstring>

namespace panvo::recorder {
namespace {

constexpr int kStepsPerCall = 10'000;        // virtual machine instructions between calls of the progress handler
constexpr std::uint64_t kStepsPerByte = 10;  // a row has at least ten bytes; sorting it takes fifty steps
constexpr std::uint64_t kMinCalls = 100;

/// The errno of a failed call. SQLite loses it when a commit fails; errno itself then still holds it, since
/// forget_errors() cleared it before the call.
int system_error_of(sqlite3* database) {
  const int known = database ? sqlite3_system_errno(database) : 0;
  return known != 0 ? known : errno;
}

void forget_errors() { errno = 0; }

std::string describe(sqlite3* database, int result) {
  const int error = system_error_of(database);
  const int primary = result & 0xff;
  if (primary == SQLITE_INTERRUPT) {
    return "takes longer to read than its size allows";
  }
  if (error != 0 && (primary == SQLITE_IOERR || primary == SQLITE_FULL || primary == SQLITE_CANTOPEN)) {
    return std::strerror(error);
  }
  return database ? sqlite3_errmsg(database) : sqlite3_errstr(result);
}

/// The path as a file: URI with SQLite's option immutable.
std::string immutable_uri(const std::filesystem::path& file) {
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(file).string()) {
    if (c == '?' || c == '#' || c == '%') {
      constexpr const char* kDigits = "0123456789ABCDEF";
      uri += {'%', kDigits[c >> 4], kDigits[c & 15]};
    } else {
      uri += c;
    }
  }
  return uri + "?immutable=1";
}

int flags(Database::Mode mode) {
  switch (mode) {
    case Database::Mode::kCreate:
      return SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX;
    case Database::Mode::kReadWrite:
      return SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX;
    case Database::Mode::kRead:
      return SQLITE_OPEN_READONLY | SQLITE_OPEN_NOMUTEX;
    case Database::Mode::kImmutable:
      break;
  }
  return SQLITE_OPEN_READONLY | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_URI;
}

}  // namespace

DatabaseError::DatabaseError(sqlite3* database, int result)
    : StorageError(describe(database, result), (result & 0xff) == SQLITE_FULL || (result & 0xff) == SQLITE_IOERR),
      code_(database ? sqlite3_extended_errcode(database) : result),
      system_error_(system_error_of(database)) {}

Database::Database(const std::filesystem::path& file, Mode mode, const char* vfs) {
  const std::string name = mode == Mode::kImmutable ? immutable_uri(file) : file.string();
  sqlite3* database = nullptr;
  forget_errors();
  const int result = sqlite3_open_v2(name.c_str(), &database, flags(mode), vfs);
  handle_.reset(database);  // must be closed even if opening failed
  if (result != SQLITE_OK) {
    throw DatabaseError(database, result);
  }
  sqlite3_extended_result_codes(database, 1);
}

void Database::inflate_covariance(std::uint64_t bytes) {
  patience_ = std::make_unique<Patience>();
  patience_->most = kMinCalls + bytes / kStepsPerCall * kStepsPerByte;
  const auto is_over = [](void* known) {
    const auto& patience = *static_cast<Patience*>(known);
    return patience.spent && ++*patience.spent > patience.most ? 1 : 0;
  };
  sqlite3_progress_handler(handle_.get(), kStepsPerCall, is_over, patience_.get());
}

void Database::execute(const std::string& sql) {
  forget_errors();
  const int result = sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (result != SQLITE_OK) {
    throw DatabaseError(handle_.get(), result);
  }
}

Statement::Statement(const Database& database, std::string_view sql)
    : database_(database.handle()), patience_(database.patience()) {
  sqlite3_stmt* statement = nullptr;
  check(sqlite3_prepare_v2(database_, sql.data(), static_cast<int>(sql.size()), &statement, nullptr));
  handle_.reset(statement);
}

Statement& Statement::bind(int parameter, std::int64_t value) {
  check(sqlite3_bind_int64(handle_.get(), parameter, value));
  return *this;
}

Statement& Statement::bind(int parameter, std::string_view value) {
  // An empty view may have a null pointer, for which SQLite would store NULL.
  const char* text = value.data() ? value.data() : "";
  check(sqlite3_bind_text64(handle_.get(), parameter, text, value.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
  return *this;
}

Statement& Statement::bind(int parameter, std::span<const std::uint8_t> value) {
  check(value.empty() ? sqlite3_bind_zeroblob(handle_.get(), parameter, 0)
                      : sqlite3_bind_blob64(handle_.get(), parameter, value.data(), value.size(), SQLITE_STATIC));
  return *this;
}

bool Statement::step() {
  forget_errors();
  if (patience_) {
    patience_->spent = &spent_;
  }
  const int result = sqlite3_step(handle_.get());
  if (patience_) {
    patience_->spent = nullptr;
  }
  if (result != SQLITE_ROW && result != SQLITE_DONE) {
    throw DatabaseError(database_, result);
  }
  return result == SQLITE_ROW;
}

void Statement::reset() noexcept {
  sqlite3_reset(handle_.get());
  spent_ = 0;
}

void Statement::run() {
  try {
    while (step()) {
    }
  } catch (const DatabaseError&) {
    reset();
    throw;
  }
  reset();
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
  if (result != SQLITE_OK) {
    throw DatabaseError(database_, result);
  }
}

}  // namespace panvo::recorder
