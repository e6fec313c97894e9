// SPDX-License-Identifier: Apache-2.0
#include "panvo/sqlite/file_header.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "panvo/sqlite/database.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::sqlite {
namespace {

FileHeader header_of(const std::string& file) {
  FileHeader header{};
  std::copy_n(file.begin(), header.size(), header.begin());
  return header;
}

TEST(FileHeader, StatesTheSizeOfTheFile) {
  for (const std::string page_size : {"512", "4096", "65536"}) {
    const panvo::test::TemporaryFolder folder;
    Database(folder / "file", Database::Mode::kCreate)
        .execute("PRAGMA page_size=" + page_size + "; CREATE TABLE t(value); INSERT INTO t VALUES(zeroblob(200000))");
    const auto file = folder.read("file");
    EXPECT_GT(file.size(), 200'000u);
    EXPECT_EQ(stated_bytes(header_of(file)), file.size()) << page_size;
  }
}

TEST(FileHeader, StatesNoSizeIfItsCountersDisagree) {
  const panvo::test::TemporaryFolder folder;
  Database(folder / "file", Database::Mode::kCreate).execute("CREATE TABLE t(value)");
  auto header = header_of(folder.read("file"));
  ++header[27];
  EXPECT_EQ(stated_bytes(header), 0u);
}

}  // namespace
}  // namespace panvo::sqlite
