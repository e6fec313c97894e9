// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration_files/write_file.hpp"

#include <gmock/gmock.h>

#include <iterator>

#include "panvo/test/temporary_folder.hpp"

namespace panvo::calibration_files {
namespace {

TEST(WriteFile, ReplacesAFileAndLeavesNoOther) {
  const panvo::test::TemporaryFolder folder;
  write_file(folder / "left.yaml", "old and longer");
  write_file(folder / "left.yaml", "new");
  EXPECT_EQ(folder.read("left.yaml"), "new");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(WriteFile, SaysThatAFileCannotBeWritten) {
  const panvo::test::TemporaryFolder folder;
  try {
    write_file(folder / "nowhere" / "left.yaml", "text");
    ADD_FAILURE() << "written";
  } catch (const FileError& error) {
    EXPECT_EQ(error.what(), (folder / "nowhere/left.yaml").string() +
                                ": cannot be written; choose a folder that exists and is writable");
  }
}

}  // namespace
}  // namespace panvo::calibration_files
