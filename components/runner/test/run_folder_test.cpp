// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>

#include "panvo/runner/run_files.hpp"
#include "panvo/runtime/errors.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::runner {
namespace {

using testing::HasSubstr;

class RunFolder : public testing::Test {
 protected:
  std::string refusal(bool overwrite = false) const {
    try {
      claim_run_folder(folder_, overwrite);
    } catch (const runtime::ConfigError& error) {
      return error.what();
    }
    return "";
  }

  const panvo::test::TemporaryFolder parent_;
  const std::filesystem::path folder_ = parent_ / "run";
};

TEST_F(RunFolder, IsTakenWhenItIsNewOrEmptyOrOfAnEarlierRun) {
  EXPECT_EQ(refusal(), "");
  std::ofstream(folder_ / "odometry_binocular.tum") << "1 2 3\n";  // left by a killed run
  EXPECT_EQ(refusal(), "");
  std::filesystem::remove_all(folder_);
  std::filesystem::create_directories(folder_);
  EXPECT_EQ(refusal(), "");
}

TEST_F(RunFolder, WithFilesOfSomebodyElseIsRefusedUnlessToldTo) {
  std::filesystem::create_directories(folder_);
  std::ofstream(folder_ / "odometry_binocular.tum") << "precious\n";
  EXPECT_THAT(refusal(), testing::AllOf(HasSubstr("contains odometry_binocular.tum"), HasSubstr("--overwrite")));
  EXPECT_THAT(refusal(), HasSubstr("--overwrite")) << "asking changes nothing";
  EXPECT_EQ(refusal(true), "");
}

TEST_F(RunFolder, OfAnEarlierRunDoesNotKeepThatOnesSummary) {
  claim_run_folder(folder_, false);
  std::ofstream(folder_ / "summary.json") << "{}";
  claim_run_folder(folder_, false);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "summary.json")) << "a run that is killed has none";
}

TEST_F(RunFolder, OfAnEarlierRunDoesNotKeepResultsOfTopicsThatTheNextOneLacks) {
  claim_run_folder(folder_, false);
  for (const char* name : {"odometry_enhanced.tum", "r2_odometry_enhanced.tum", "odometry_enhanced_covariance.csv",
                           "states.csv", "notes.txt", "run.log"}) {
    std::ofstream(folder_ / name) << "earlier\n";
  }
  claim_run_folder(folder_, false);
  std::set<std::string> left;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) left.insert(entry.path().filename());
  EXPECT_THAT(left, testing::ElementsAre(".panvo_run", "notes.txt", "run.log"));
}

TEST_F(RunFolder, OfSomebodyElseKeepsItsFilesWithOtherNames) {
  std::filesystem::create_directories(folder_);
  for (const char* name : {"states.csv", "my_states.csv"}) std::ofstream(folder_ / name) << "precious\n";
  claim_run_folder(folder_, true);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "states.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "my_states.csv"));
}

TEST_F(RunFolder, ThatIsAFileIsRefused) {
  std::ofstream(folder_) << "a file";
  EXPECT_THAT(refusal(true), HasSubstr("is a file"));
}

}  // namespace
}  // namespace panvo::runner
