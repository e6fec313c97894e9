// SPDX-License-Identifier: Apache-2.0
// Malicious SQLite files that would cost a reader more time or memory than their size justifies.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "panvo/recorder/bag_reader.hpp"
#include "panvo/sqlite/database.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "test_bag.hpp"

namespace panvo::recorder {
namespace {

using namespace test;
using panvo::test::TemporaryFolder;
using sqlite::Database;
using sqlite::Statement;
using testing::HasSubstr;

constexpr std::uint64_t kCount = 50;

class UntrustedBag : public testing::Test {
 protected:
  void SetUp() override {
    BagWriter writer(folder_ / "bag");
    write_numbered(writer, kCount, 40);
    writer.close();
  }

  void change(const std::string& sql) const { Database(file_, Database::Mode::kReadWrite).execute(sql); }

  std::string refusal() const {
    return error_of([&] { BagReader reader(file_); });
  }

  std::size_t root_of(const char* table) const {
    const Database database(file_, Database::Mode::kRead);
    Statement root(database, "SELECT rootpage FROM sqlite_master WHERE name = ?");
    root.bind(1, table).step();
    return static_cast<std::size_t>(root.integer(0));
  }

  TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "bag" / "bag_0.db3";
};

TEST_F(UntrustedBag, WhoseMessagesAreAViewWithoutEndIsRefused) {
  change(
      "DROP TABLE messages; CREATE VIEW messages(id, topic_id, timestamp, data) AS WITH RECURSIVE n(i) AS (SELECT 1 "
      "UNION ALL SELECT i + 1 FROM n) SELECT i, 1, i, x'00' FROM n");
  EXPECT_THAT(refusal(), HasSubstr("no table messages"));
}

TEST_F(UntrustedBag, WhoseTopicsAreAViewIsRefused) {
  change("ALTER TABLE topics RENAME TO t; CREATE VIEW topics AS SELECT * FROM t");
  EXPECT_THAT(refusal(), HasSubstr("no table topics"));
}

TEST_F(UntrustedBag, WhoseDataAreComputedIsRefused) {
  change(
      "DROP TABLE messages; CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id, timestamp, data AS "
      "(zeroblob(900000000)))");
  EXPECT_THAT(refusal(), HasSubstr("no table messages with column data"));
}

TEST_F(UntrustedBag, WhoseStampsSpanMoreThanNumbersDoIsReadFrom1970On) {
  change(
      "UPDATE messages SET timestamp = -9223372036854775808 WHERE id = 1; "
      "UPDATE messages SET timestamp = 9223372036854775806 WHERE id = 2");
  BagReader reader(file_);
  EXPECT_EQ(reader.metadata().message_count, kCount - 1);
  EXPECT_EQ(reader.metadata().duration_ns, 9223372036854775806 - (kStart + 2 * kStep));
  EXPECT_EQ(read_all(reader).size(), kCount - 1);
}

void put(std::string& page, std::size_t at, std::size_t value, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; ++i) {
    page[at + i] = static_cast<char>(value >> 8 * (bytes - 1 - i));
  }
}

/// An interior page of a table's b-tree with 60 branches that all point to page `child`.
std::string page_of_branches(std::size_t page_size, std::size_t child) {
  constexpr std::size_t kBranches = 60, kHead = 12, kCell = 5;
  std::string page(page_size, '\0');
  page[0] = 5;  // interior page of a table b-tree
  put(page, 3, kBranches, 2);
  put(page, 5, page_size - kBranches * kCell, 2);
  put(page, 8, child, 4);
  for (std::size_t i = 0; i < kBranches; ++i) {
    const auto cell = page_size - (i + 1) * kCell;
    put(page, kHead + 2 * i, cell, 2);
    put(page, cell, child, 4);
    page[cell + 4] = static_cast<char>(i + 1);  // its largest id
  }
  return page;
}

TEST_F(UntrustedBag, WhoseBranchesGrowTogetherAgainIsNotWalkedToItsEnd) {
  change("DROP INDEX timestamp_idx; PRAGMA journal_mode=DELETE; PRAGMA page_size=512; VACUUM");
  const auto root = root_of("messages");
  auto file = folder_.read(file_);
  constexpr std::size_t kPage = 512, kLevels = 10;  // 60^10 rows
  const auto pages = file.size() / kPage;
  const auto leaf = file.substr((root_of("topics") - 1) * kPage, kPage);
  file.replace((root - 1) * kPage, kPage, page_of_branches(kPage, pages + 1));
  for (std::size_t level = 1; level < kLevels; ++level) {
    file += page_of_branches(kPage, pages + level + 1);
  }
  file += leaf;
  put(file, 28, file.size() / kPage, 4);
  folder_.write(file_, file);
  EXPECT_EQ(error_of([&] {
              BagReader reader(file_);
              EXPECT_TRUE(any_contains(reader.warnings(), "longer to read than its size allows"));
              EXPECT_LE(read_all(reader).size(), kCount);
            }),
            "");
}

}  // namespace
}  // namespace panvo::recorder
