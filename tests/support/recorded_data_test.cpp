// SPDX-License-Identifier: Apache-2.0
#include "panvo/test/recorded_data.hpp"

#include <gmock/gmock.h>
#include <stdlib.h>

#include "panvo/test/temporary_folder.hpp"

namespace panvo::test {
namespace {

/// A checkout beside a folder of recordings; without PANVO_DATA.
class FolderOfRecordings : public testing::Test {
 protected:
  FolderOfRecordings() { ::unsetenv("PANVO_DATA"); }

  const TemporaryFolder folder_;
  const std::filesystem::path walk_ = folder_.write("shared/data/walk", "");
  const std::string source_ = folder_ / "checkout/components/vision/test/a_test.cpp";
};

TEST_F(FolderOfRecordings, LiesBesideTheCheckoutOfTheCaller) {
  EXPECT_EQ(recorded_data("walk", source_.c_str()), walk_);
  EXPECT_EQ(recorded_data("bags/walk", source_.c_str()), folder_ / "shared/data/bags/walk") << "which does not exist";
}

TEST_F(FolderOfRecordings, IsTheOneThatIsNamedIfAny) {
  ::setenv("PANVO_DATA", "/elsewhere", 1);
  EXPECT_EQ(recorded_data("walk", source_.c_str()), "/elsewhere/walk");
  ::setenv("PANVO_DATA", "", 1);
  EXPECT_EQ(recorded_data("walk", source_.c_str()), walk_);
}

TEST_F(FolderOfRecordings, ThatIsMissingIsToldWithTheRemedy) {
  EXPECT_EQ(missing_recording("/elsewhere/walk"),
            "/elsewhere/walk is missing; set PANVO_DATA to the folder of recordings");
}

}  // namespace
}  // namespace panvo::test
