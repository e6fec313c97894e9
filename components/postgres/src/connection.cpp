// SPDX-License-Identifier: Apache-2.0
#include "panvo/postgres/connection.hpp"

#include <libpq-fe.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <string_view>

namespace panvo::postgres {
namespace {

// Types of columns [pg_type.dat].
constexpr Oid kBytea = 17, kBigint = 20, kText = 25, kDouble = 701;

using Clock = std::chrono::steady_clock;
using Buffer = std::array<char, 8>;

std::string trimmed(const char* message) {
  std::string text = message ? message : "";
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  std::ranges::replace(text, '\n', ' ');
  return text;
}

Buffer big_endian(std::uint64_t bits) {
  Buffer bytes;
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(bits >> (56 - 8 * i));
  return bytes;
}

std::uint64_t from_big_endian(std::span<const std::uint8_t> bytes) {
  std::uint64_t bits = 0;
  for (const auto byte : bytes) bits = bits << 8 | byte;
  return bits;
}

/// Parameters as PQsendQueryParams wants them.
struct Parameters {
  explicit Parameters(std::span<const Value> values) : numbers(values.size()) {
    for (std::size_t i = 0; i < values.size(); ++i) std::visit([&](const auto& value) { add(value, i); }, values[i]);
  }
  void add(std::int64_t value, std::size_t i) { add_number(kBigint, static_cast<std::uint64_t>(value), i); }
  void add(double value, std::size_t i) { add_number(kDouble, std::bit_cast<std::uint64_t>(value), i); }
  void add(std::string_view value, std::size_t) { add(kText, value.data(), value.size()); }
  void add(std::span<const std::uint8_t> value, std::size_t) {
    add(kBytea, reinterpret_cast<const char*>(value.data()), value.size());
  }
  void add_number(Oid type, std::uint64_t bits, std::size_t i) {
    numbers[i] = big_endian(bits);
    add(type, numbers[i].data(), numbers[i].size());
  }
  void add(Oid type, const char* data, std::size_t size) {
    types.push_back(type);
    data_of.push_back(data ? data : "");  // a null pointer would be NULL
    sizes.push_back(static_cast<int>(size));
    formats.push_back(1);
  }

  std::vector<Buffer> numbers;
  std::vector<Oid> types;
  std::vector<const char*> data_of;
  std::vector<int> sizes, formats;
};

struct Clear {
  void operator()(PGresult* result) const noexcept { PQclear(result); }
  void operator()(PGconn* connection) const noexcept { PQfinish(connection); }
  void operator()(PQconninfoOption* options) const noexcept { PQconninfoFree(options); }
};
using ResultHandle = std::unique_ptr<PGresult, Clear>;

/// The server ends sessions with these: shutdown, crash of another session, too many connections.
bool ends_session(std::string_view state) {
  return state.starts_with("08") || state.starts_with("57P") || state == "25P03" || state == "53300";
}

DatabaseError error_of(const PGresult* result, const PGconn* connection) {
  const char* state = PQresultErrorField(result, PG_DIAG_SQLSTATE);
  const char* message = PQresultErrorField(result, PG_DIAG_MESSAGE_PRIMARY);
  const bool is_lost = PQstatus(connection) == CONNECTION_BAD || (state && ends_session(state));
  return {trimmed(message ? message : PQresultErrorMessage(result)), state ? state : "", is_lost};
}

/// Whether host and port may be such: those of a location with a password that is not encoded contain parts of it.
bool are_plausible(const PQconninfoOption* options) {
  for (; options->keyword; ++options) {
    const std::string_view name = options->keyword, value = options->val ? options->val : "";
    if (name == "port" && value.find_first_not_of("0123456789,") != std::string_view::npos) return false;
    if (name == "host" && value.find('@', 1) != std::string_view::npos) return false;  // "@/path": an abstract socket
  }
  return true;
}

/// Throws an error without libpq's text, which would quote a part of the location: perhaps of the password.
void check_location(const std::string& location) {
  char* message = nullptr;
  const std::unique_ptr<PQconninfoOption, Clear> options(PQconninfoParse(location.c_str(), &message));
  PQfreemem(message);
  if (options && are_plausible(options.get())) return;
  throw DatabaseError(
      "the location is malformed; the form is postgresql://USER@HOST:PORT/DATABASE?OPTION=VALUE, with special "
      "characters "
      "of a password as %XX",
      "", false);
}

}  // namespace

bool is_available() noexcept { return true; }

bool DatabaseError::is_conflict() const noexcept {
  // serialization failure, deadlock, lock not available, statement canceled by its timeout
  return state_ == "40001" || state_ == "40P01" || state_ == "55P03" || state_ == "57014";
}

struct Result::Content {
  ResultHandle result;
};

int Result::rows() const noexcept { return content_ ? PQntuples(content_->result.get()) : 0; }

namespace {

std::span<const std::uint8_t> field(const PGresult* result, int row, int column, Oid type) {
  if (row >= PQntuples(result) || column >= PQnfields(result) || PQftype(result, column) != type ||
      PQgetisnull(result, row, column)) {
    const char* name = PQfname(result, column);
    throw DatabaseError(std::string("column ") + (name ? name : "") + " is missing, NULL or of another type", "",
                        false);
  }
  return {reinterpret_cast<const std::uint8_t*>(PQgetvalue(result, row, column)),
          static_cast<std::size_t>(PQgetlength(result, row, column))};
}

}  // namespace

std::int64_t Result::integer(int row, int column) const {
  return static_cast<std::int64_t>(from_big_endian(field(content_->result.get(), row, column, kBigint)));
}

double Result::real(int row, int column) const {
  return std::bit_cast<double>(from_big_endian(field(content_->result.get(), row, column, kDouble)));
}

std::string Result::text(int row, int column) const {
  const auto bytes = field(content_->result.get(), row, column, kText);
  return {bytes.begin(), bytes.end()};
}

std::span<const std::uint8_t> Result::bytes(int row, int column) const {
  return field(content_->result.get(), row, column, kBytea);
}

struct Connection::Handle {
  std::unique_ptr<PGconn, Clear> connection;
  std::chrono::seconds limit{10};

  PGconn* open() const {
    if (!connection) throw DatabaseError("the connection was lost", "", true);
    return connection.get();
  }

  [[noreturn]] void lose(const std::string& why) {
    connection.reset();
    throw DatabaseError(why, "", true);
  }

  /// Until the socket is ready, or for the longest time without a byte.
  void wait(short events) {
    pollfd socket{PQsocket(open()), events, 0};
    const auto end = Clock::now() + limit;
    while (true) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
      const int ready = ::poll(&socket, 1, static_cast<int>(std::max<std::int64_t>(left, 0)));
      if (ready > 0) return;
      if (ready == 0 || (errno != EINTR && errno != EAGAIN)) {
        lose("the server did not answer for " + std::to_string(limit.count()) + " s");
      }
    }
  }

  void consume() {
    if (PQconsumeInput(open()) == 0) lose(trimmed(PQerrorMessage(open())));
  }

  /// After a query was sent: its last result.
  ResultHandle answer() {
    while (const int left = PQflush(open())) {
      if (left < 0) lose(trimmed(PQerrorMessage(open())));
      wait(POLLIN | POLLOUT);
      consume();
    }
    ResultHandle last, failed;
    while (true) {
      while (PQisBusy(open())) {
        wait(POLLIN);
        consume();
      }
      ResultHandle next(PQgetResult(open()));
      if (!next) break;
      const auto status = PQresultStatus(next.get());
      auto& kept = status == PGRES_TUPLES_OK || status == PGRES_COMMAND_OK ? last : failed;
      if (&kept == &last || !failed) kept = std::move(next);
    }
    if (!failed) return last;
    const auto error = error_of(failed.get(), open());
    if (error.is_lost()) connection.reset();
    throw error;
  }
};

Connection::Connection(const std::string& location, Limits limits) : handle_(std::make_unique<Handle>()) {
  check_location(location);
  const auto seconds = std::to_string(limits.connect_s);
  // Later keywords prevail: those of the location over the first ones.
  const char* keywords[] = {"connect_timeout", "application_name", "dbname", "client_encoding", nullptr};
  const char* values[] = {seconds.c_str(), "panvo", location.c_str(), "UTF8", nullptr};
  handle_->connection.reset(PQconnectdbParams(keywords, values, 1));
  handle_->limit = std::chrono::seconds(limits.answer_s + 2);  // the server should give up first
  if (PQstatus(handle_->connection.get()) != CONNECTION_OK) {
    handle_->lose(trimmed(PQerrorMessage(handle_->connection.get())));
  }
  PQsetNoticeProcessor(
      handle_->connection.get(), [](void*, const char*) {}, nullptr);
  PQsetnonblocking(handle_->connection.get(), 1);
  const auto limit_ms = std::to_string(1000 * limits.answer_s);
  // A client that stalls within a transaction must not hold its locks for long, either.
  const auto session = "SET statement_timeout = " + limit_ms + "; SET lock_timeout = " + limit_ms +
                       "; SET idle_in_transaction_session_timeout = 60000";
  execute(session.c_str());
}

Connection::~Connection() = default;

Result Connection::query(const char* sql, std::span<const Value> parameters) {
  const Parameters sent(parameters);
  if (PQsendQueryParams(handle_->open(), sql, static_cast<int>(parameters.size()), sent.types.data(),
                        sent.data_of.data(), sent.sizes.data(), sent.formats.data(), 1) == 0) {
    handle_->lose(trimmed(PQerrorMessage(handle_->open())));
  }
  return Result(std::make_shared<Result::Content>(Result::Content{handle_->answer()}));
}

void Connection::execute(const char* sql) {
  if (PQsendQuery(handle_->open(), sql) == 0) handle_->lose(trimmed(PQerrorMessage(handle_->open())));
  handle_->answer();
}

bool Connection::is_open() const noexcept { return handle_->connection != nullptr; }

}  // namespace panvo::postgres
