// SPDX-License-Identifier: Apache-2.0
#include "panvo/sqlite/database.hpp"

#include <cerrno>
#include <cstring>

namespace panvo::sqlite {
namespace {

constexpr int kStepsPerCall = 10'000;        // virtual machine instructions between calls of the progress handler
constexpr std::uint64_t kStepsPerByte = 10;  // a row has at least ten bytes; sorting it takes fifty steps
constexpr std::uint64_t kMinCalls = 100;

void forget_errors() { errno = 0; }

/// The errno of a failed call; 0 if the operating system did not cause the failure. SQLite loses it when a commit fails;
/// errno itself then still holds it, since forget_errors() cleared it before the call.
int system_error_of(sqlite3* database, int result) {
  const int primary = result & 0xff;
  if (primary != SQLITE_IOERR && primary != SQLITE_FULL && primary != SQLITE_CANTOPEN) return 0;
  const int known = database ? sqlite3_system_errno(database) : 0;
  return known != 0 ? known : errno;
}

std::string describe(sqlite3* database, int result) {
  if ((result & 0xff) == SQLITE_INTERRUPT) return "takes longer to read than its size allows";
  if (const int error = system_error_of(database, result); error != 0) return std::strerror(error);
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
    : std::runtime_error(describe(database, result)),
      code_(database ? sqlite3_extended_errcode(database) : result),
      system_error_(system_error_of(database, result)) {}

Database::Database(const std::filesystem::path& file, Mode mode, const char* vfs) {
  const std::string name = mode == Mode::kImmutable ? immutable_uri(file) : file.string();
  sqlite3* database = nullptr;
  forget_errors();
  const int result = sqlite3_open_v2(name.c_str(), &database, flags(mode), vfs);
  handle_.reset(database);  // must be closed even if opening failed
  if (result != SQLITE_OK) throw DatabaseError(database, result);
  sqlite3_extended_result_codes(database, 1);
}

void Database::limit_steps(std::uint64_t bytes) {
  step_limit_ = std::make_unique<StepLimit>();
  step_limit_->max_calls = kMinCalls + bytes / kStepsPerCall * kStepsPerByte;
  const auto is_over = [](void* known) {
    const auto& limit = *static_cast<StepLimit*>(known);
    return limit.spent && ++*limit.spent > limit.max_calls ? 1 : 0;
  };
  sqlite3_progress_handler(handle_.get(), kStepsPerCall, is_over, step_limit_.get());
}

void Database::execute(const std::string& sql) {
  forget_errors();
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

Statement::Statement(const Database& database, std::string_view sql)
    : database_(database.handle()), step_limit_(database.step_limit_.get()) {
  sqlite3_stmt* statement = nullptr;
  forget_errors();  // preparing reads the schema
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

Statement& Statement::bind(int parameter, const Statement& row, int column) {
  check(sqlite3_bind_value(handle_.get(), parameter, sqlite3_column_value(row.handle_.get(), column)));
  return *this;
}

bool Statement::step() {
  forget_errors();
  if (step_limit_) step_limit_->spent = &spent_;
  const int result = sqlite3_step(handle_.get());
  if (step_limit_) step_limit_->spent = nullptr;
  if (result != SQLITE_ROW && result != SQLITE_DONE) throw DatabaseError(database_, result);
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
  if (result != SQLITE_OK) throw DatabaseError(database_, result);
}

}  // namespace panvo::sqlite
