// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/run_comparison.hpp"

#include <gmock/gmock.h>

#include "panvo/test/temporary_folder.hpp"

namespace panvo::evaluation {
namespace {

using ::testing::HasSubstr;

class RunComparison : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* run : {"run/", "expected/"}) {
      folder_.write(run + std::string("odometry_binocular.tum"), "1.0 0 0 0 0 0 0 1\n1.1 1 0 0 0 0 0 1\n");
      folder_.write(run + std::string("outcomes.csv"),
                    "stamp_ns,landmark_id,outcome,chi_square,reason\n7,3,applied,1.25,\"\"\n");
    }
  }

  std::vector<FileComparison> compare(const RunTolerance& tolerance = {}) const {
    return compare_runs(folder_ / "run", folder_ / "expected", tolerance);
  }

  panvo::test::TemporaryFolder folder_;
};

TEST_F(RunComparison, FindsNothingBetweenEqualRuns) {
  const auto files = compare();
  ASSERT_EQ(files.size(), 2u);
  for (const auto& file : files) EXPECT_FALSE(file.difference) << file.name << *file.difference;
  EXPECT_EQ(files[0].name, "odometry_binocular.tum");
  EXPECT_EQ(files[0].lines, 2u);
}

TEST_F(RunComparison, NamesTheFirstLineThatDiffersByABit) {
  folder_.write("run/odometry_binocular.tum", "1.0 0 0 0 0 0 0 1\n1.1 1.0000000000000002 0 0 0 0 0 1\n");
  EXPECT_THAT(compare()[0].difference.value_or(""), HasSubstr("line 2"));
}

TEST_F(RunComparison, AllowsPosesTheToleranceAndNoMore) {
  folder_.write("run/odometry_binocular.tum", "1.0 0 0 0 0 0 0 1\n1.1 1 0.03 0 0 0 0 1\n");
  const auto within = compare({.position_m = 0.04, .rotation_deg = 0.1});
  EXPECT_FALSE(within[0].difference);
  EXPECT_NEAR(within[0].worst_m.value_or(-1.0), 0.03, 1e-12);
  EXPECT_THAT(compare({.position_m = 0.02, .rotation_deg = 0.1})[0].difference.value_or(""), HasSubstr("pose 2"));
}

TEST_F(RunComparison, NoticesATurnThatIsTooLarge) {
  folder_.write("run/odometry_binocular.tum",
                "1.0 0 0 0 0 0 0 1\n1.1 1 0 0 0 0 0.008726535 0.999961923\n");  // 1 degree
  EXPECT_FALSE(compare({.position_m = 0.1, .rotation_deg = 1.1})[0].difference);
  EXPECT_TRUE(compare({.position_m = 0.1, .rotation_deg = 0.9})[0].difference);
}

TEST_F(RunComparison, WantsTheSameEventsWhateverWasMeasuredOfThem) {
  const RunTolerance tolerance{.position_m = 0.1, .rotation_deg = 1.0};
  const std::string header = "stamp_ns,landmark_id,outcome,chi_square,reason\n";
  folder_.write("run/outcomes.csv", header + "7,3,applied,1.26,\"by 1, or so\"\n");
  EXPECT_FALSE(compare(tolerance)[1].difference);
  EXPECT_TRUE(compare()[1].difference);
  folder_.write("run/outcomes.csv", header + "7,4,applied,1.25,\"\"\n");
  EXPECT_THAT(compare(tolerance)[1].difference.value_or(""), HasSubstr("7,4,applied"));
  folder_.write("run/outcomes.csv", header + "7,3,rejected,1.25,\"\"\n");
  EXPECT_TRUE(compare(tolerance)[1].difference);
  folder_.write("run/outcomes.csv", header);
  EXPECT_THAT(compare(tolerance)[1].difference.value_or(""), HasSubstr("1 lines, expected 2"));
}

TEST_F(RunComparison, MissesAFileAndAPose) {
  std::filesystem::remove(folder_ / "run/outcomes.csv");
  folder_.write("run/odometry_binocular.tum", "1.0 0 0 0 0 0 0 1\n");
  const auto files = compare({.position_m = 1.0, .rotation_deg = 1.0});
  EXPECT_THAT(files[0].difference.value_or(""), HasSubstr("1 poses, expected 2"));
  EXPECT_EQ(files[1].difference, "is missing");
}

TEST_F(RunComparison, RefusesFoldersWithoutResults) {
  std::filesystem::create_directories(folder_ / "empty");
  EXPECT_THROW(compare_runs(folder_ / "run", folder_ / "empty"), InputError);
  EXPECT_THROW(compare_runs(folder_ / "nowhere", folder_ / "expected"), InputError);
}

}  // namespace
}  // namespace panvo::evaluation
