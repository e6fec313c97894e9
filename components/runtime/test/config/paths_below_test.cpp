// SPDX-License-Identifier: Apache-2.0
#include "config/paths_below.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "panvo/test/temporary_folder.hpp"

namespace panvo::runtime {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class PathsBelow : public testing::Test {
 protected:
  PathsBelow() {
    fs::create_directories(allowed_ / "maps");
    fs::create_directories(folder_.path() / "allowed_too");
  }

  bool is_allowed(const fs::path& path) const { return !path_problem(path.string(), allowed_); }

  panvo::test::TemporaryFolder folder_;
  const fs::path allowed_ = folder_.path() / "allowed";
};

TEST_F(PathsBelow, WhatLiesBelowTheFolderMayBeNamedThereOrNot) {
  EXPECT_TRUE(is_allowed(allowed_ / "maps"));
  EXPECT_TRUE(is_allowed(allowed_ / "maps/"));
  EXPECT_TRUE(is_allowed(allowed_ / "new/deeper/store.db"));
  EXPECT_TRUE(is_allowed(allowed_ / "maps" / ".." / "store.db"));
  EXPECT_TRUE(is_allowed("")) << "names nothing";
}

TEST_F(PathsBelow, WhatLiesElsewhereMayNot) {
  EXPECT_FALSE(is_allowed("/etc/passwd"));
  EXPECT_FALSE(is_allowed("store.db")) << "below the working directory";
  EXPECT_FALSE(is_allowed(folder_.path() / "allowed_too" / "store.db")) << "the name only begins alike";
  EXPECT_FALSE(is_allowed(allowed_)) << "the folder itself is not below it";
  EXPECT_FALSE(is_allowed(allowed_.string() + "/"));
  EXPECT_FALSE(is_allowed(allowed_.string() + std::string("/a\0b", 4)));
}

TEST_F(PathsBelow, DotsAndLinksAreFollowedFirst) {
  EXPECT_FALSE(is_allowed(allowed_ / ".." / "allowed_too" / "store.db"));
  EXPECT_FALSE(is_allowed(allowed_ / "new" / ".." / ".." / "store.db"));
  fs::create_directory_symlink(folder_.path() / "allowed_too", allowed_ / "link");
  EXPECT_FALSE(is_allowed(allowed_ / "link" / "store.db"));
  fs::create_symlink(folder_.path() / "not_there", allowed_ / "dangling");
  EXPECT_FALSE(is_allowed(allowed_ / "dangling")) << "whoever writes to it makes what it leads to";
  fs::create_directory_symlink(allowed_, folder_.path() / "way_in");
  EXPECT_TRUE(is_allowed(folder_.path() / "way_in" / "store.db"));
}

TEST_F(PathsBelow, WithoutAFolderNoneMay) {
  EXPECT_THAT(path_problem("/tmp/x", "").value_or(""), HasSubstr("files_below"));
  EXPECT_THAT(path_problem("/tmp/x", folder_.path() / "gone").value_or(""), HasSubstr("does not exist"));
  EXPECT_FALSE(path_problem("", ""));
}

}  // namespace
}  // namespace panvo::runtime
