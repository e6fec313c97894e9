// SPDX-License-Identifier: Apache-2.0
#include "panvo/test/temporary_folder.hpp"

#include <gmock/gmock.h>

#include <optional>

namespace panvo::test {
namespace {

namespace fs = std::filesystem;

TEST(TemporaryFolder, IsNewEmptyAndNobodyElses) {
  const TemporaryFolder one, other;
  EXPECT_NE(one.path(), other.path());
  EXPECT_TRUE(fs::is_empty(one.path()));
}

TEST(TemporaryFolder, IsRemovedWithItsContent) {
  std::optional<TemporaryFolder> folder(std::in_place);
  const fs::path path = folder->path();
  folder->write("deep/er/file", "text");
  folder.reset();
  EXPECT_FALSE(fs::exists(path));
}

TEST(TemporaryFolder, KeepsEveryByteOfAFile) {
  const TemporaryFolder folder;
  const std::string bytes("\r\n\0\xff\n", 5);
  EXPECT_EQ(folder.write("deep/file", bytes), folder / "deep/file");
  EXPECT_EQ(folder.read("deep/file"), bytes);
  EXPECT_EQ(folder.read("nowhere"), "");
}

TEST(TemporaryFolder, SaysWhereNothingCanBeWritten) {
  const TemporaryFolder folder;
  const auto problem_of = [](const auto& action) -> std::string {
    try {
      action();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(problem_of([&] { TemporaryFolder below(folder / "nowhere"); }),
            "cannot create a temporary folder in " + (folder / "nowhere").string() + ": No such file or directory");
  fs::create_directory(folder / "taken");
  EXPECT_EQ(problem_of([&] { folder.write("taken", "text"); }), "cannot write " + (folder / "taken").string());
}

}  // namespace
}  // namespace panvo::test
