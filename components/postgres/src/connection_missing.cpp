// SPDX-License-Identifier: Apache-2.0
// Takes the place of connection.cpp where libpq is not installed.
#include "panvo/postgres/connection.hpp"

namespace panvo::postgres {
namespace {

[[noreturn]] void refuse() {
  throw DatabaseError("this build of panvo has no PostgreSQL: install libpq-dev and build again", "", false);
}

}  // namespace

struct Result::Content {};
struct Connection::Handle {};

bool is_available() noexcept { return false; }
bool DatabaseError::is_conflict() const noexcept { return false; }
int Result::rows() const noexcept { return 0; }
std::int64_t Result::integer(int, int) const { refuse(); }
double Result::real(int, int) const { refuse(); }
std::string Result::text(int, int) const { refuse(); }
std::span<const std::uint8_t> Result::bytes(int, int) const { refuse(); }
Connection::Connection(const std::string&, Limits) { refuse(); }
Connection::~Connection() = default;
Result Connection::query(const char*, std::span<const Value>) { refuse(); }
void Connection::execute(const char*) { refuse(); }
bool Connection::is_open() const noexcept { return false; }

}  // namespace panvo::postgres
