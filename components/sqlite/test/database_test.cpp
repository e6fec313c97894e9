// SPDX-License-Identifier: Apache-2.0
#include "panvo/sqlite/database.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cerrno>
#include <csignal>
#include <functional>
#include <limits>
#include <vector>

#include "panvo/test/temporary_folder.hpp"

namespace panvo::sqlite {
namespace {

using Mode = Database::Mode;
using testing::ElementsAre;

class SqliteFile : public testing::Test {
 protected:
  SqliteFile() { Database(file_, Mode::kCreate).execute("CREATE TABLE t(value UNIQUE NOT NULL)"); }

  static std::int64_t count(const Database& database) {
    Statement statement(database, "SELECT count(*) FROM t");
    statement.step();
    return statement.integer(0);
  }
  static DatabaseError error_of(const std::function<void()>& action) {
    try {
      action();
    } catch (const DatabaseError& error) {
      return error;
    }
    ADD_FAILURE() << "no error";
    return {nullptr, SQLITE_OK};
  }

  panvo::test::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "100 %, or not? #1";
};

TEST_F(SqliteFile, GivesBackWhatWasBound) {
  Database database(file_, Mode::kReadWrite);
  const std::vector<std::uint8_t> bytes{0, 1, 255};
  Statement insert(database, "INSERT INTO t VALUES(?)");
  insert.bind(1, std::numeric_limits<std::int64_t>::min()).run();
  insert.bind(1, 0.1).run();
  insert.bind(1, "text").run();
  insert.bind(1, std::span(bytes)).run();
  Statement rows(database, "SELECT value FROM t");
  ASSERT_EQ(rows.columns(), 1);
  EXPECT_TRUE(rows.step());
  EXPECT_EQ(rows.integer(0), std::numeric_limits<std::int64_t>::min());
  EXPECT_TRUE(rows.step());
  EXPECT_EQ(rows.real(0), 0.1);
  EXPECT_TRUE(rows.step());
  EXPECT_EQ(rows.text(0), "text");
  EXPECT_TRUE(rows.step());
  EXPECT_THAT(rows.blob(0), ElementsAre(0, 1, 255));
  EXPECT_FALSE(rows.step());
}

TEST_F(SqliteFile, StoresEmptyTextsAndBlobsAsSuch) {
  Database database(file_, Mode::kReadWrite);
  Statement insert(database, "INSERT INTO t VALUES(?)");
  insert.bind(1, std::string_view()).run();  // NULL would be refused
  insert.bind(1, std::span<const std::uint8_t>()).run();
  Statement types(database, "SELECT group_concat(typeof(value)) FROM t");
  types.step();
  EXPECT_EQ(types.text(0), "text,blob");
}

TEST_F(SqliteFile, TakesValuesOfAnotherStatementAsTheyAre) {
  Database database(file_, Mode::kReadWrite);
  database.execute("INSERT INTO t VALUES(7), (0.5), ('text'), (x'00ff'); CREATE TABLE copy(value)");
  Statement rows(database, "SELECT value FROM t"), insert(database, "INSERT INTO copy VALUES(?)");
  while (rows.step()) insert.bind(1, rows, 0).run();
  Statement copied(database, "SELECT group_concat(quote(value)) FROM copy");
  copied.step();
  EXPECT_EQ(copied.text(0), "7,0.5,'text',X'00FF'");
}

TEST_F(SqliteFile, ForgetsATransactionThatIsNotCommitted) {
  Database database(file_, Mode::kReadWrite);
  {
    Transaction transaction(database);
    database.execute("INSERT INTO t VALUES(1)");
    EXPECT_TRUE(database.in_transaction());
  }
  EXPECT_FALSE(database.in_transaction());
  EXPECT_EQ(count(database), 0);
  Transaction transaction(database);
  database.execute("INSERT INTO t VALUES(1)");
  transaction.commit();
  EXPECT_EQ(count(Database(file_, Mode::kRead)), 1);
}

TEST_F(SqliteFile, IsReadAsImmutableWhateverItsNameWhileAnotherLocksIt) {
  Database writer(file_, Mode::kReadWrite);
  writer.execute("INSERT INTO t VALUES(1); BEGIN EXCLUSIVE");
  EXPECT_EQ(count(Database(file_, Mode::kImmutable)), 1);
  const auto error = error_of([&] { count(Database(file_, Mode::kRead)); });
  EXPECT_EQ(error.primary_code(), SQLITE_BUSY);
}

TEST_F(SqliteFile, IsNotCreatedByReading) {
  EXPECT_EQ(error_of([&] { Database(folder_ / "none", Mode::kReadWrite); }).primary_code(), SQLITE_CANTOPEN);
  const Database database(file_, Mode::kRead);
  EXPECT_TRUE(database.is_read_only());
}

TEST_F(SqliteFile, CanBeWrittenAgainAfterAnErrorWithItsExtendedCode) {
  Database database(file_, Mode::kReadWrite);
  Statement insert(database, "INSERT INTO t VALUES(?)");
  insert.bind(1, "one").run();
  const auto error = error_of([&] { insert.run(); });
  EXPECT_EQ(error.code(), SQLITE_CONSTRAINT_UNIQUE);
  EXPECT_EQ(error.primary_code(), SQLITE_CONSTRAINT);
  EXPECT_EQ(error.system_error(), 0);
  EXPECT_STREQ(error.what(), "UNIQUE constraint failed: t.value");
  insert.bind(1, "two").run();
  EXPECT_EQ(count(database), 2);
}

TEST_F(SqliteFile, NamesTheErrorOfTheOperatingSystem) {
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto ignored = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limited{100'000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &limited);
  for (const std::size_t bytes : {300'000, 10'000'000}) {  // written by COMMIT, by INSERT
    const auto error = error_of([&] {
      Database database(file_, Mode::kReadWrite);
      Transaction transaction(database);
      Statement(database, "INSERT INTO t VALUES(?)").bind(1, std::string(bytes, 'x')).run();
      transaction.commit();
    });
    EXPECT_STREQ(error.what(), "File too large") << bytes;
    EXPECT_EQ(error.system_error(), EFBIG) << bytes;
    EXPECT_EQ(error.primary_code(), SQLITE_IOERR) << bytes;
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, ignored);
}

TEST_F(SqliteFile, ThatIsNotTrustedCannotKeepAReaderForever) {
  Database database(file_, Mode::kRead);
  database.limit_steps(std::filesystem::file_size(file_));
  const char* sum = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n LIMIT ?) SELECT sum(i) FROM n";
  Statement endless(database, sum), long_one(database, sum);
  endless.bind(1, std::int64_t{-1});
  EXPECT_STREQ(error_of([&] { endless.step(); }).what(), "takes longer to read than its size allows");
  long_one.bind(1, std::int64_t{20'000});
  for (int i = 0; i < 20; ++i) long_one.run();  // the limit is that of one run
}

}  // namespace
}  // namespace panvo::sqlite
