// SPDX-License-Identifier: Apache-2.0
// The whole bench on a rendered recording of three seconds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "panvo/test/temporary_folder.hpp"
#include "process.hpp"
#include "rendered_walk.hpp"

namespace panvo::test {
namespace {

using testing::HasSubstr;
using testing::Not;

struct FaultBench : testing::Test {
  void SetUp() override { RenderedWalk{.frames = 30}.write(folder / "walk"); }

  Finished bench(const std::vector<std::string>& more) const {
    std::vector<std::string> words{FAULT_BENCH, "--inputs", folder / "walk", "--out", folder / "out"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }

  TemporaryFolder folder;
};

TEST_F(FaultBench, PlaysTheFaultsItIsAskedForAndLeavesItsTable) {
  const Finished finished = bench({"--only", "none,both_black", "--key", "first"});
  ASSERT_EQ(finished.status, 0) << finished.output;
  EXPECT_THAT(finished.output, HasSubstr("2 of 2 runs"));
  for (const char* file : {"faults.txt", "faults.csv", "faults.json"}) {
    EXPECT_THAT(read_file(folder / "out" / file), HasSubstr("both_black")) << file;
  }
  const auto json = nlohmann::json::parse(read_file(folder / "out" / "faults.json"));
  EXPECT_EQ(json.at("rows").size(), 2U);
  EXPECT_EQ(json.at("rows").at(0).at("poses"), 30);
  EXPECT_LT(json.at("rows").at(0).at("max_error_m"), 0.1);
  const auto qualities = read_file(folder / "out" / "runs" / "walk" / "both_black-1" / "quality.csv");
  EXPECT_THAT(qualities, HasSubstr(",0,")) << "nothing was unreliable";
}

TEST_F(FaultBench, DoesNotPlayAgainWhatIsThereUnlessSomethingElseIsRun) {
  ASSERT_EQ(bench({"--only", "none", "--key", "first"}).status, 0);
  const auto log = folder / "out" / "runs" / "walk" / "none-1" / "output.log";
  std::ofstream(log) << "kept";
  ASSERT_EQ(bench({"--only", "none", "--key", "first"}).status, 0);
  EXPECT_EQ(read_file(log), "kept");
  ASSERT_EQ(bench({"--only", "none", "--key", "second"}).status, 0);
  EXPECT_NE(read_file(log), "kept");
}

TEST_F(FaultBench, SaysThatARunFailedAndWhere) {
  const Finished finished = bench({"--only", "none", "--run", "/bin/false"});
  EXPECT_EQ(finished.status, 1);
  EXPECT_THAT(finished.output, testing::AllOf(HasSubstr("1 failed"), HasSubstr("none-1/output.log")));
}

TEST_F(FaultBench, NamesTheKindsWhereOneIsWrong) {
  const Finished finished = bench({"--only", "melted"});
  EXPECT_EQ(finished.status, 2);
  EXPECT_THAT(finished.output, testing::AllOf(HasSubstr("melted"), HasSubstr("both_frozen")));
}

}  // namespace
}  // namespace panvo::test
