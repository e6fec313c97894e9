// SPDX-License-Identifier: Apache-2.0
// Command line of panvo_evaluate.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "panvo/test/temporary_folder.hpp"

namespace panvo::evaluation {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Outcome {
  int status = -1;
  std::string out;
  std::string err;
};

class CommandLine : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("truth.tum", tum(0.0));
    folder_.write("run/odometry_binocular.tum", tum(0.01));
  }

  // 60 m along x with a lateral drift of `drift` times the distance.
  static std::string tum(double drift) {
    std::ostringstream text;
    for (int i = 0; i < 61; ++i) text << 0.1 * i << " " << i << " " << drift * i << " 0 0 0 0 1\n";
    return text.str();
  }

  Outcome call(const std::string& arguments, const std::string& before = "") const {
    const std::string command = "cd '" + folder_.path().string() + "' && " + before + " " PANVO_EVALUATE " " +
                                arguments + " > out.txt 2> err.txt < /dev/null";
    const int status = std::system(command.c_str());
    return {WEXITSTATUS(status), folder_.read("out.txt"), folder_.read("err.txt")};
  }

  panvo::test::TemporaryFolder folder_;
};

TEST_F(CommandLine, PrintsATableAndWritesTheFiles) {
  const Outcome outcome = call("run truth.tum --out result --no-plot");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_THAT(outcome.out, HasSubstr("absolute trajectory error"));
  EXPECT_THAT(folder_.read("result/errors.csv"), HasSubstr("estimate,stamp_ns"));
  EXPECT_NEAR(nlohmann::json::parse(folder_.read("result/evaluation.json"))["estimates"][0]["end_error_percent"], 1.0,
              1e-6);
}

TEST_F(CommandLine, WritesIntoTheRunsFolderIfNotToldWhere) {
  EXPECT_EQ(call("run truth.tum --no-plot").status, 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "run/evaluation.json"));
}

TEST_F(CommandLine, PrintsNothingButJsonWhereAsked) {
  const Outcome outcome = call("run truth.tum --json --no-plot --segments 5,15 --align se3 --also other=truth.tum");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["errors_aligned_by"], "se3");
  EXPECT_EQ(json["estimates"][1]["name"], "other");
  ASSERT_EQ(json["estimates"][0]["segments"]["by_length"].size(), 2u);
  EXPECT_EQ(json["estimates"][0]["segments"]["by_length"][1]["length_m"], 15.0);
}

TEST_F(CommandLine, FailsOnBadInputNamingIt) {
  folder_.write("broken.tum", "0 0 0 0 0 0 0 1\n1 0 0 nan 0 0 0 1\n");
  const Outcome outcome = call("broken.tum truth.tum --no-plot");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_THAT(outcome.err, HasSubstr("broken.tum:2: field 4 is not a finite number"));
  EXPECT_EQ(call("run nowhere --no-plot").status, 1);
  EXPECT_EQ(call("run truth.tum --no-plot --also run=truth.tum").status, 1);
  EXPECT_EQ(call("run truth.tum --no-plot --out truth.tum").status, 1);
}

TEST_F(CommandLine, WritesNothingIntoTheGroundTruthWhenItsArgumentsAreSwapped) {
  folder_.write("data/poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 1\n");
  const Outcome outcome = call("data run --no-plot");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("data: is not a run folder"), HasSubstr("--out")));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "data/evaluation.json"));
}

TEST_F(CommandLine, ReplacesAnEarlierEvaluationButNoFilesOfSomebodyElse) {
  folder_.write("mine/errors.csv", "precious");
  const Outcome outcome = call("run truth.tum --no-plot --out mine");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr("mine/errors.csv: exists"));
  EXPECT_EQ(folder_.read("mine/errors.csv"), "precious");
  EXPECT_EQ(call("run truth.tum --no-plot").status, 0);
  EXPECT_EQ(call("run truth.tum --no-plot").status, 0) << "again";
}

TEST_F(CommandLine, DoesNotTakeAnInterruptedRunForFinished) {
  folder_.write("run/summary.json", R"({"interrupted": true})");
  const Outcome outcome = call("run truth.tum --no-plot");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("run/summary.json: the run was interrupted"), HasSubstr("--partial")));
  EXPECT_EQ(call("truth.tum truth.tum --no-plot --also other=run").status, 1);
  EXPECT_EQ(call("run truth.tum --no-plot --partial").status, 0);
  folder_.write("run/summary.json", R"({"interrupted": false})");
  EXPECT_EQ(call("run truth.tum --no-plot").status, 0);
}

TEST_F(CommandLine, DoesNotTakeAKilledRunForFinished) {
  folder_.write("run/.panvo_run", "");
  const Outcome outcome = call("run truth.tum --no-plot");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr("it has no summary.json"));
}

TEST_F(CommandLine, FailsOnBadUsage) {
  EXPECT_EQ(call("run").status, 2);
  EXPECT_EQ(call("run truth.tum --algn se3").status, 2);
  EXPECT_EQ(call("run truth.tum --align sideways").status, 2);
  EXPECT_EQ(call("run truth.tum --segments 10,-5").status, 2);
}

TEST_F(CommandLine, PrintsTheFiguresAlsoWithoutGnuplot) {
  const Outcome outcome = call("run truth.tum --out result", "PATH=/nonexistent");
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.out, HasSubstr("absolute trajectory error"));
  EXPECT_THAT(outcome.err, HasSubstr("apt-get install gnuplot-nox"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "result/evaluation.json"));
}

TEST_F(CommandLine, ExplainsItself) {
  const Outcome outcome = call("--help");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, HasSubstr("--segments"));
}

}  // namespace
}  // namespace panvo::evaluation
