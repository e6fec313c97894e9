// SPDX-License-Identifier: Apache-2.0
#include "panvo/postgres/connection.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "panvo/test/postgres_server.hpp"

namespace panvo::postgres {
namespace {

using panvo::test::PostgresServer;
using testing::HasSubstr;

class ServerConnection : public testing::Test {
 protected:
  void SetUp() override {
    if (!is_available()) GTEST_SKIP() << "built without libpq; install libpq-dev";
    PANVO_SKIP_WITHOUT_POSTGRES();
    server_ = &PostgresServer::shared();
  }
  void TearDown() override {
    if (!server_) return;
    server_->thaw();
    server_->start();
  }
  std::string location() const { return server_->location("postgres"); }

  PostgresServer* server_ = nullptr;
};

/// The error of an action; fails if there is none.
template <class Action>
DatabaseError error_of(Action action) {
  try {
    action();
  } catch (const DatabaseError& error) {
    return error;
  }
  ADD_FAILURE() << "no error";
  return {"", "", false};
}

TEST_F(ServerConnection, GivesBackParametersBitForBit) {
  Connection connection(location());
  const std::vector<std::uint8_t> bytes{0, 255, '\\', '\'', 0};
  const double smallest = std::numeric_limits<double>::denorm_min();
  const auto row = connection.query("SELECT $1, $2, $3, $4, $5, $6",
                                    {std::numeric_limits<std::int64_t>::min(), smallest, -0.0,
                                     std::string_view("x'); DROP TABLE y; --ü"), std::span(bytes), std::string_view()});
  ASSERT_EQ(row.rows(), 1);
  EXPECT_EQ(row.integer(0, 0), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(row.real(0, 1), smallest);
  EXPECT_TRUE(std::signbit(row.real(0, 2)));
  EXPECT_EQ(row.text(0, 3), "x'); DROP TABLE y; --ü");
  EXPECT_TRUE(std::ranges::equal(row.bytes(0, 4), bytes));
  EXPECT_EQ(row.text(0, 5), "");
}

TEST_F(ServerConnection, RefusesColumnsOfAnotherTypeAndNull) {
  Connection connection(location());
  const auto row = connection.query("SELECT 1::int AS small, NULL::bigint AS nothing, 2::bigint AS good");
  EXPECT_THAT(error_of([&] { row.integer(0, 0); }).what(),
              HasSubstr("column small is missing, NULL or of another type"));
  EXPECT_THAT(error_of([&] { row.integer(0, 1); }).what(), HasSubstr("column nothing"));
  EXPECT_THAT(error_of([&] { row.real(0, 2); }).what(), HasSubstr("column good"));
  EXPECT_THAT(error_of([&] { row.integer(1, 2); }).what(), HasSubstr("column good"));
  EXPECT_EQ(row.integer(0, 2), 2);
}

TEST_F(ServerConnection, TellsAnErrorOfAStatementAndGoesOn) {
  Connection connection(location());
  const auto error = error_of([&] { connection.query("SELECT nothing FROM nowhere"); });
  EXPECT_EQ(error.state(), "42P01");
  EXPECT_FALSE(error.is_lost());
  EXPECT_EQ(connection.query("SELECT 5::bigint").integer(0, 0), 5);
}

TEST_F(ServerConnection, RollsBackATransactionThatIsNotCommitted) {
  Connection connection(location());
  connection.execute("CREATE TEMPORARY TABLE t(x bigint)");
  {
    const Transaction transaction(connection);
    connection.query("INSERT INTO t VALUES(1)");
  }
  {
    Transaction transaction(connection);
    connection.query("INSERT INTO t VALUES(2)");
    transaction.commit();
  }
  const auto rows = connection.query("SELECT x FROM t");
  ASSERT_EQ(rows.rows(), 1);
  EXPECT_EQ(rows.integer(0, 0), 2);
}

TEST_F(ServerConnection, IsLostWhenItsSessionIsKilled) {
  Connection victim(location()), killer(location());
  const auto pid = victim.query("SELECT pg_backend_pid()::bigint").integer(0, 0);
  killer.query("SELECT pg_terminate_backend($1::int)::text", {pid});
  const auto error = error_of([&] { victim.query("SELECT 1"); });
  EXPECT_TRUE(error.is_lost());
  EXPECT_FALSE(victim.is_open());
  EXPECT_TRUE(error_of([&] { victim.query("SELECT 1"); }).is_lost());
}

TEST_F(ServerConnection, IsLostWhenTheServerStops) {
  Connection connection(location());
  server_->stop();
  EXPECT_TRUE(error_of([&] { connection.query("SELECT 1"); }).is_lost());
  const auto error = error_of([&] { const Connection another(location()); });
  EXPECT_TRUE(error.is_lost());
  EXPECT_THAT(error.what(), HasSubstr("connection to server"));
}

TEST_F(ServerConnection, WaitsForAFrozenServerNoLongerThanItsLimits) {
  Connection connection(location(), {.connect_s = 2, .answer_s = 1});
  server_->freeze();
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_THAT(error_of([&] { connection.query("SELECT 1"); }).what(), HasSubstr("did not answer for 3 s"));
  EXPECT_TRUE(error_of([&] { const Connection another(location(), {.connect_s = 2, .answer_s = 1}); }).is_lost());
  // Not a measure of speed: without limits both would wait for ever.
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60));
}

TEST_F(ServerConnection, SendsMuchToAFrozenServerWithoutWaitingForEver) {
  Connection connection(location(), {.connect_s = 2, .answer_s = 1});
  server_->freeze();
  const std::vector<std::uint8_t> much(50'000'000);
  EXPECT_TRUE(error_of([&] { connection.query("SELECT length($1)::bigint", {std::span(much)}); }).is_lost());
}

TEST_F(ServerConnection, GivesUpAStatementThatTakesTooLong) {
  Connection connection(location(), {.connect_s = 5, .answer_s = 1});
  const auto error = error_of([&] { connection.query("SELECT pg_sleep(60)::text"); });
  EXPECT_EQ(error.state(), "57014");
  EXPECT_TRUE(error.is_conflict());
  EXPECT_TRUE(connection.is_open());
}

TEST(Connection, OfAMalformedLocationTellsNothingOfAPassword) {
  if (!is_available()) GTEST_SKIP() << "built without libpq; install libpq-dev";
  for (const char* location : {"postgresql://robot:se%zzcret@server/db", "postgresql://robot:5x/se@cret/db",
                               "postgresql://robot:se@cret@server/db", "postgresql://server/db?nonsense=secret"}) {
    const auto error = error_of([&] { const Connection connection(location); });
    EXPECT_THAT(error.what(), HasSubstr("the location is malformed; the form is postgresql://"));
    for (const char* part : {"cret", "zz", "5x", "nonsense"}) {
      EXPECT_THAT(error.what(), testing::Not(HasSubstr(part))) << location;
    }
  }
}

}  // namespace
}  // namespace panvo::postgres
