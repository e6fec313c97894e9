// SPDX-License-Identifier: Apache-2.0
#include "files_below.hpp"

#include <gtest/gtest.h>

#include "assets.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "protocol_error.hpp"

namespace panvo::web_view {
namespace {

TEST(FileBelow, FindsFilesOfTheFolderAndNothingElse) {
  const panvo::test::TemporaryFolder folder;
  const auto page = folder.path() / "page";
  folder.write("page/index.html", "page");
  folder.write("page/sub/a-b_1.js", "script");
  folder.write("page/.hidden", "hidden");
  folder.write("secret", "secret");
  EXPECT_EQ(file_below(page, "/"), page / "index.html");
  EXPECT_EQ(file_below(page, "/sub/a-b_1.js"), page / "sub" / "a-b_1.js");
  for (const char* path : {"", "index.html", "/none", "/sub", "/sub/", "/.hidden", "/..", "/../secret",
                           "/sub/../../secret", "//secret", "/./index.html", "/..\\secret", "/sub//a-b_1.js"})
    EXPECT_EQ(file_below(page, path), std::nullopt) << path;
  EXPECT_EQ(file_below(page, folder.path().string() + "/secret"), std::nullopt);
  EXPECT_EQ(file_below(page, std::string_view("/index.html\0", 12)), std::nullopt);
}

TEST(Assets, AreFilesOfPackages) {
  const panvo::test::TemporaryFolder folder;
  folder.write("rig/meshes/camera.stl", "mesh");
  EXPECT_EQ(read_asset(folder.path(), "package://rig/meshes/camera.stl"), "mesh");
  for (const char* uri : {"package://rig/none.stl", "package://../rig/meshes/camera.stl", "file:/etc/passwd",
                          "package:///etc/passwd", "package:/", ""})
    EXPECT_THROW(read_asset(folder.path(), uri), ProtocolError) << uri;
  EXPECT_THROW(read_asset({}, "package://rig/meshes/camera.stl"), ProtocolError);
}

}  // namespace
}  // namespace panvo::web_view
