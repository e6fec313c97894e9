// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace panvo::postgres {

/// Whether this build can connect; libpq is optional.
bool is_available() noexcept;

/// A server refused a statement, or the connection was lost.
class DatabaseError : public std::runtime_error {
 public:
  DatabaseError(const std::string& message, std::string state, bool is_lost)
      : std::runtime_error(message), state_(std::move(state)), is_lost_(is_lost) {}

  /// SQLSTATE [PostgreSQL manual, appendix A]; empty without an answer of the server.
  const std::string& state() const noexcept { return state_; }
  /// The connection cannot be used any more: stopped, killed, stalled or unreachable server.
  bool is_lost() const noexcept { return is_lost_; }
  /// The same transaction may succeed if it is repeated: another one was in its way.
  bool is_conflict() const noexcept;

 private:
  std::string state_;
  bool is_lost_;
};

/// Longest waits. The first holds unless the location has its own connect_timeout.
struct Limits {
  int connect_s = 5;  ///< for each host of the location; libpq waits for 2 s at least
  int answer_s = 10;  ///< for the next bytes of an answer; statements and locks also end after it on the server
};

/// Value of a parameter. Views must live until the call returns.
using Value = std::variant<std::int64_t, double, std::string_view, std::span<const std::uint8_t>>;

/// Rows of an answer; rows and columns count from 0. Values are binary, so that they are exact.
class Result {
 public:
  Result() = default;

  int rows() const noexcept;
  /// Of a bigint column. Like the others, throws DatabaseError for a column of another type and for NULL.
  std::int64_t integer(int row, int column) const;
  double real(int row, int column) const;                          ///< of a double precision column
  std::string text(int row, int column) const;                     ///< of a text column
  std::span<const std::uint8_t> bytes(int row, int column) const;  ///< of a bytea column; valid as long as the result

 private:
  friend class Connection;
  struct Content;
  explicit Result(std::shared_ptr<const Content> content) : content_(std::move(content)) {}

  std::shared_ptr<const Content> content_;
};

/// An open connection. No function waits longer than the limits; all throw DatabaseError. Once one was lost, the
/// connection is closed, and the next call throws again. Not thread-safe.
class Connection {
 public:
  /// `location`: a URI of libpq. Passwords may come from it, PGPASSWORD, PGPASSFILE or ~/.pgpass.
  explicit Connection(const std::string& location, Limits limits = {});
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Runs one statement with parameters $1, $2, ...
  Result query(const char* sql, std::span<const Value> parameters);
  Result query(const char* sql, std::initializer_list<Value> parameters = {}) {
    return query(sql, std::span(parameters.begin(), parameters.size()));
  }
  /// Runs statements without parameters and discards their results.
  void execute(const char* sql);

  bool is_open() const noexcept;

 private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
};

/// Rolls back unless committed.
class Transaction {
 public:
  explicit Transaction(Connection& connection, const char* begin = "BEGIN") : connection_(connection) {
    connection_.execute(begin);
  }
  ~Transaction() {
    if (is_ended_ || !connection_.is_open()) return;
    try {
      connection_.execute("ROLLBACK");
    } catch (const DatabaseError&) {  // the server rolls back when the connection ends
    }
  }
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;

  void commit() {
    is_ended_ = true;
    connection_.execute("COMMIT");
  }

 private:
  Connection& connection_;
  bool is_ended_ = false;
};

}  // namespace panvo::postgres
