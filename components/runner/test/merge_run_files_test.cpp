// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "panvo/runner/run_files.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "run_samples.hpp"

namespace panvo::runner {
namespace {

using panvo::test::TemporaryFolder;
using testing::ElementsAre;

TEST(MergeRunFiles, MakesOneRunOfSeveralContainers) {
  const TemporaryFolder folder;
  runtime::StageTimes times;
  times.add("track", 2'000'000, 1'000'000);
  {
    RunFiles player(folder.path() / "player");
    player.write(odometry_topic("/ground_truth/odometry"), sample_of(odometry_at(1, 0, 1)));
    player.finish(summary_of("player", 10), {{"player", times.snapshot()}});
    RunFiles odometry(folder.path() / "odometry");
    odometry.write(kBinocular, sample_of(odometry_at(1, 0, 2)));
    auto summary = summary_of("odometry", 12);
    summary.exit_status = 3;
    odometry.finish(summary, {{"odometry", times.snapshot()}});
  }
  folder.write("player/run.log", "player");
  folder.write("odometry/run.log", "odometry");
  folder.write("run.log", "of an earlier run");
  EXPECT_TRUE(merge_run_files(folder.path(), {"player", "odometry"}, true));

  const auto summary = nlohmann::json::parse(folder.read("summary.json"));
  EXPECT_EQ(summary["frames_in"], 200);
  EXPECT_EQ(summary["cpu_s"], 3.0);
  EXPECT_EQ(summary["wall_s"], 12.0);
  EXPECT_EQ(summary["peak_memory_mb"], 241.0);
  EXPECT_EQ(summary["queues"].size(), 2U);
  EXPECT_EQ(summary["changed_parameters"].size(), 2U);
  EXPECT_EQ(summary["exit_status"], 3);
  EXPECT_EQ(summary["version"], "0.1.0");
  EXPECT_EQ(summary["problems"].size(), 2U);
  const auto timing = nlohmann::json::parse(folder.read("timing.json"));
  EXPECT_EQ(timing["components"].size(), 2U);
  EXPECT_EQ(timing["components"]["player"]["stages"]["track"]["count"], 1);
  EXPECT_EQ(folder.read("ground_truth.tum"), "1.000000000 1 0 0 0 0 0 1\n");
  EXPECT_EQ(folder.read("odometry_binocular.tum"), "1.000000000 2 0 0 0 0 0 1\n");
  EXPECT_EQ(folder.read("run.log"), "player");
  EXPECT_EQ(folder.read("odometry_run.log"), "odometry");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "player"));
}

TEST(MergeRunFiles, NamesContainersThatWereKilledAndKeepsWhatTheyLeft) {
  const TemporaryFolder folder;
  RunFiles(folder.path() / "player").finish(summary_of("player", 10), {});
  RunFiles(folder.path() / "odometry").write(kBinocular, sample_of(odometry_at(1, 0, 2)));
  folder.write("cut/summary.json", "{\"version\": \"0.1");
  merge_run_files(folder.path(), {"odometry", "player", "cut", "none"}, false);
  const auto summary = nlohmann::json::parse(folder.read("summary.json"));
  EXPECT_EQ(summary["exit_status"], 1);
  EXPECT_EQ(summary["version"], "0.1.0");
  EXPECT_THAT(summary["problems"].get<std::vector<std::string>>(),
              ElementsAre("player was late", "container odometry left no summary.json: it did not finish",
                          "container cut left no summary.json: it did not finish",
                          "container none left no summary.json: it did not finish"));
  EXPECT_EQ(folder.read("odometry_binocular.tum"), "1.000000000 2 0 0 0 0 0 1\n");
  EXPECT_EQ(nlohmann::json::parse(folder.read("timing.json"))["components"], nlohmann::json::object());
}

TEST(MergeRunFiles, ReportsARunInWhichNoContainerWroteAnything) {
  const TemporaryFolder folder;
  for (const bool must_have_results : {false, true}) {
    for (const char* container : {"player", "odometry"}) {
      RunFiles files(folder.path() / container);
      files.finish(RunSummary{}, {});
    }
    EXPECT_NE(merge_run_files(folder.path(), {"player", "odometry"}, must_have_results), must_have_results);
    const auto summary = nlohmann::json::parse(folder.read("summary.json"));
    EXPECT_EQ(summary["exit_status"], must_have_results ? 1 : 0);
    EXPECT_EQ(summary["problems"].size(), must_have_results ? 1U : 0U);
  }
}

}  // namespace
}  // namespace panvo::runner
