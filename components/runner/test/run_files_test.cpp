// SPDX-License-Identifier: Apache-2.0
#include "panvo/runner/run_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "odometry_lines.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "panvo_msgs/msg/AzimuthChange.h"
#include "panvo_msgs/msg/CorrectionOutcome.h"
#include "panvo_msgs/msg/LandmarkMatch.h"
#include "panvo_msgs/msg/LocalizationState.h"
#include "panvo_msgs/msg/PanoramicLandmark.h"
#include "panvo_msgs/msg/PositionCorrection.h"
#include "run_samples.hpp"

namespace panvo::runner {
namespace {

using panvo::test::TemporaryFolder;
using testing::_;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

std::size_t columns_of(const std::string& line) { return 1U + std::count(line.begin(), line.end(), ','); }

TEST(StampText, KeepsEveryNanosecond) {
  EXPECT_EQ(stamp_text(1'317'046'452'003'070'009), "1317046452.003070009");
  EXPECT_EQ(stamp_text(0), "0.000000000");
  EXPECT_EQ(stamp_text(-500'000'000), "-0.500000000");
  EXPECT_EQ(stamp_text(-1'000'000'001), "-1.000000001");
}

TEST(RunFiles, WantsTheOdometryTopicsAndNoOthers) {
  const TemporaryFolder folder;
  const RunFiles files(folder.path());
  EXPECT_TRUE(files.wants(kBinocular));
  EXPECT_TRUE(files.wants(odometry_topic("/odometry/enhanced")));
  EXPECT_TRUE(files.wants(odometry_topic("/robot/ground_truth/odometry")));
  EXPECT_FALSE(files.wants(odometry_topic("/odometry/visual")));
  EXPECT_FALSE(files.wants(odometry_topic("/visual_odometry/binocular")));
  auto other_type = kBinocular;
  other_type.type_name = "sensor_msgs/msg/Image";
  EXPECT_FALSE(files.wants(other_type));
}

TEST(RunFiles, WritesEachPoseAtOnceAndWithoutLoss) {
  const TemporaryFolder folder;
  RunFiles files((folder.path() / "a/b").string());
  files.write(kBinocular, sample_of(odometry_at(1317046452, 3070009, 0.1 + 0.2)));
  EXPECT_EQ(folder.read("a/b/odometry_binocular.tum"), "1317046452.003070009 0.30000000000000004 0 0 0 0 0 1\n");
  files.write(kBinocular, sample_of(odometry_at(1317046453, 0, -1e-9)));
  files.write(odometry_topic("/odometry/enhanced"), sample_of(odometry_at(0, 1, 2)));
  files.write(odometry_topic("/ground_truth/odometry"), sample_of(odometry_at(0, 1, 3)));
  EXPECT_THAT(lines_of(folder.read("a/b/odometry_binocular.tum")),
              ElementsAre(HasSubstr("1317046452"), "1317046453.000000000 -1e-09 0 0 0 0 0 1"));
  EXPECT_EQ(folder.read("a/b/odometry_enhanced.tum"), "0.000000001 2 0 0 0 0 0 1\n");
  EXPECT_EQ(folder.read("a/b/ground_truth.tum"), "0.000000001 3 0 0 0 0 0 1\n");
}

TEST(RunFiles, WritesLandmarksAndMatches) {
  const TemporaryFolder folder;
  RunFiles files(folder.path());
  panvo_msgs::msg::PanoramicLandmark landmark;
  landmark.header().stamp().sec(2);
  landmark.id(7);
  landmark.is_junction(true);
  landmark.pose().pose().position().x(1.5);
  landmark.pose().pose().orientation().w(1.0);
  landmark.pose().covariance()[0] = 0.04;
  landmark.keypoints().resize(3);
  landmark.keypoints()[1].has_point(true);
  const auto landmarks = topic_of<panvo_msgs::msg::PanoramicLandmark>("/landmarks");
  ASSERT_TRUE(files.wants(landmarks));
  files.write(landmarks, sample_of(landmark));
  EXPECT_THAT(lines_of(folder.read("landmarks.csv")),
              ElementsAre(HasSubstr("stamp_ns,id,"), "2000000000,7,1,1.5,0,0,0,0,0,1,0.2,0,3,1"));

  panvo_msgs::msg::LandmarkMatch match;
  match.header().stamp().nanosec(5);
  match.state(panvo_msgs::msg::LandmarkMatch_Constants::REJECTED);
  match.reason("8 inliers, \"12\" needed");
  match.landmark_id(7);
  match.large_distance(0.5);
  match.small_distance(std::numeric_limits<double>::quiet_NaN());
  match.candidates(4);
  const auto matches = topic_of<panvo_msgs::msg::LandmarkMatch>("/robot/landmarks/match");
  ASSERT_TRUE(files.wants(matches));
  files.write(matches, sample_of(match));
  const auto lines = lines_of(folder.read("matches.csv"));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[1], "5,rejected,7,0,0,0.5,,4,0,0,\"8 inliers, \"\"12\"\" needed\"");
  EXPECT_EQ(columns_of(lines[0]), 11U);
}

TEST(RunFiles, WritesWhatTheLocalizerIsToldAndSays) {
  const TemporaryFolder folder;
  RunFiles files(folder.path());
  panvo_msgs::msg::AzimuthChange change;
  change.header().stamp().sec(3);
  change.from_stamp().sec(2);
  change.azimuth_change_rad(0.5);
  change.variance_rad2(0.04);
  change.motion_azimuth_rad(-0.25);
  change.motion_azimuth_variance_rad2(0.01);
  change.valid(true);
  files.write(topic_of<panvo_msgs::msg::AzimuthChange>("/compass/azimuth_change"), sample_of(change));
  EXPECT_THAT(lines_of(folder.read("azimuth.csv")), ElementsAre(_, "3000000000,2000000000,0.5,0.2,0,-0.25,0.1,1,\"\""));

  panvo_msgs::msg::PositionCorrection correction;
  correction.landmark_id(4);
  correction.state(panvo_msgs::msg::PositionCorrection_Constants::FULL);
  correction.inliers(31);
  correction.landmark_from_base().pose().position().y(-2.0);
  correction.landmark_from_base().pose().orientation().w(1.0);
  correction.landmark_from_base().covariance()[35] = 0.25;
  files.write(topic_of<panvo_msgs::msg::PositionCorrection>("/correction"), sample_of(correction));
  EXPECT_THAT(lines_of(folder.read("corrections.csv")), ElementsAre(_, "0,4,full,31,0,-2,0,0,0,0,1,0,0,0.5,\"\""));

  panvo_msgs::msg::CorrectionOutcome outcome;
  outcome.landmark_id(4);
  outcome.outcome(panvo_msgs::msg::CorrectionOutcome_Constants::REJECTED);
  outcome.reason("too far");
  outcome.chi_square(99.5);
  outcome.after().position().x(1.25);
  files.write(topic_of<panvo_msgs::msg::CorrectionOutcome>("/correction/outcome"), sample_of(outcome));
  const auto outcomes = lines_of(folder.read("outcomes.csv"));
  ASSERT_EQ(outcomes.size(), 2U);
  EXPECT_EQ(outcomes[1], "0,4,rejected,99.5,0,0,0,0,0,0,1,1.25,0,0,0,0,0,1,\"too far\"");
  EXPECT_EQ(columns_of(outcomes[0]), columns_of(outcomes[1]));

  panvo_msgs::msg::LocalizationState state;
  state.state(panvo_msgs::msg::LocalizationState_Constants::LOST);
  state.position_sigma_m(std::numeric_limits<double>::infinity());
  files.write(topic_of<panvo_msgs::msg::LocalizationState>("/localization/state"), sample_of(state));
  EXPECT_THAT(lines_of(folder.read("states.csv")), ElementsAre(_, "0,lost,,0,\"\""));
}

TEST(RunFiles, WritesBothCovariancesAndTheTwist) {
  const TemporaryFolder folder;
  RunFiles files(folder.path());
  files.write(kBinocular, sample_of(odometry_at(1, 5, 0)));
  const auto lines = lines_of(folder.read("odometry_binocular_covariance.csv"));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_TRUE(lines[0].starts_with("stamp_ns,p00,p01,p02,p03,p04,p05,p10,"));
  EXPECT_THAT(lines[0], HasSubstr(",p55,t00,"));
  EXPECT_TRUE(lines[0].ends_with(",t55,vx,vy,vz,wx,wy,wz"));
  EXPECT_EQ(columns_of(lines[0]), 1U + 36 + 36 + 6);
  EXPECT_EQ(columns_of(lines[1]), columns_of(lines[0]));
  EXPECT_TRUE(lines[1].starts_with("1000000005,0,0,0,0,0,0,0,0.25,0,")) << lines[1];
  EXPECT_TRUE(lines[1].ends_with(",1e-06,2,0,0,0,0,0")) << lines[1];
}

TEST(RunFiles, LeavesOutWhatIsNotFiniteOrNoMessageAndSaysSo) {
  const TemporaryFolder folder;
  RunFiles files(folder.path());
  files.write(kBinocular, sample_of(odometry_at(1, 0, std::numeric_limits<double>::quiet_NaN())));
  auto unsure = odometry_at(2, 0, 0);
  unsure.pose().covariance()[0] = std::numeric_limits<double>::infinity();
  files.write(kBinocular, sample_of(unsure));
  const auto& type = interfaces::message_type<Odometry>();
  files.write(kBinocular, runtime::Sample::from_bytes(&type, std::string(type.name), {0, 1, 0, 0, 9}, 0));
  EXPECT_THAT(lines_of(folder.read("odometry_binocular.tum")), ElementsAre(HasSubstr("2.000000000 ")));
  EXPECT_EQ(lines_of(folder.read("odometry_binocular_covariance.csv")).size(), 2U) << "header and the first";
  files.finish({}, {});
  const auto problems = nlohmann::json::parse(folder.read("summary.json"))["problems"].get<std::vector<std::string>>();
  EXPECT_THAT(problems,
              ElementsAre("odometry_binocular.tum lacks 2 messages of /odometry/binocular: undecodable, or with "
                          "non-finite numbers",
                          HasSubstr("odometry_binocular_covariance.csv lacks 2 messages")));
}

TEST(RunFiles, KeepsTheOdometryOfTwoRobotsApart) {
  const TemporaryFolder folder;
  RunFiles files(folder.path());
  files.write(odometry_topic("/a/odometry/binocular"), sample_of(odometry_at(1, 0, 1)));
  files.write(odometry_topic("/fleet/b/odometry/binocular"), sample_of(odometry_at(1, 0, 2)));
  files.write(odometry_topic("/a/odometry/binocular"), sample_of(odometry_at(2, 0, 1)));
  EXPECT_EQ(lines_of(folder.read("odometry_binocular.tum")).size(), 2U);
  EXPECT_EQ(folder.read("fleet_b_odometry_binocular.tum"), "1.000000000 2 0 0 0 0 0 1\n");
}

TEST(RunFiles, RemovesWhatAnEarlierRunLeft) {
  const TemporaryFolder folder;
  for (const char* name :
       {"odometry_binocular.tum", "odometry_binocular_covariance.csv", "summary.json", "timing.json"}) {
    folder.write(name, "old");
  }
  folder.write("notes.txt", "mine");
  const RunFiles files(folder.path());
  std::vector<std::string> left;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    left.push_back(entry.path().filename());
  }
  EXPECT_THAT(left, ElementsAre("notes.txt"));
}

TEST(RunFiles, LeavesWhatItHadWhenTheProcessIsKilled) {
  const TemporaryFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    RunFiles files(folder.path());
    files.write(kBinocular, sample_of(odometry_at(1, 0, 1)));
    files.write(kBinocular, sample_of(odometry_at(2, 0, 2)));
    raise(SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(WTERMSIG(status), SIGKILL);
  EXPECT_EQ(folder.read("odometry_binocular.tum"), "1.000000000 1 0 0 0 0 0 1\n2.000000000 2 0 0 0 0 0 1\n");
}

/// Limits the file size of this process during its lifetime, to simulate a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

TEST(RunFiles, KeepsWholeLinesWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  RunFiles files(folder.path());
  const auto enhanced = odometry_topic("/odometry/enhanced");
  files.write(enhanced, sample_of(odometry_at(1, 0, 1)));
  {
    const FileSizeLimit limit(40);  // within the second line
    try {
      files.write(enhanced, sample_of(odometry_at(2, 0, 2)));
      FAIL() << "it fitted";
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr("cannot write " + (folder.path() / "odometry_enhanced.tum").string() + ": "));
      EXPECT_THAT(error.what(), HasSubstr("free space there"));
    }
    EXPECT_EQ(folder.read("odometry_enhanced.tum"), "1.000000000 1 0 0 0 0 0 1\n");
    EXPECT_THROW(files.finish({}, {}), std::runtime_error);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "summary.json"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "summary.json.part"));
  }
  files.write(enhanced, sample_of(odometry_at(3, 0, 3)));
  EXPECT_EQ(folder.read("odometry_enhanced.tum"), "1.000000000 1 0 0 0 0 0 1\n3.000000000 3 0 0 0 0 0 1\n");
}

TEST(RunFiles, RefusesAFolderThatCannotBeWrittenTo) {
  const TemporaryFolder folder;
  const auto file = folder.write("file", "");
  for (const auto& bad : {file, file / "below", std::filesystem::path("/proc/panvo")}) {
    try {
      const RunFiles files(bad);
      FAIL() << bad;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr("cannot write " + bad.string()));
      EXPECT_THAT(error.what(), HasSubstr("choose a writable folder"));
    }
  }
}

TEST(RunFiles, FinishLeavesTimesAndSummary) {
  const TemporaryFolder folder;
  RunFiles files(folder.path());
  runtime::StageTimes times;
  times.add("track", 2'000'000, 1'000'000);
  times.add("track", 4'000'000, 1'000'000);
  files.finish(summary_of("odometry", 10), {{"odometry", times.snapshot()}, {"rectifier", {}}});

  const auto timing = nlohmann::json::parse(folder.read("timing.json"));
  EXPECT_EQ(timing["components"]["rectifier"]["stages"], nlohmann::json::object());
  const auto& track = timing["components"]["odometry"]["stages"]["track"];
  EXPECT_EQ(track["count"], 2);
  EXPECT_DOUBLE_EQ(track["wall_ms"]["mean"], 3.0);
  EXPECT_NEAR(track["wall_ms"]["median"], 2.0, 0.04);
  EXPECT_DOUBLE_EQ(track["wall_ms"]["p95"], 4.0);
  EXPECT_DOUBLE_EQ(track["wall_ms"]["p99"], 4.0);
  EXPECT_DOUBLE_EQ(track["wall_ms"]["max"], 4.0);
  EXPECT_DOUBLE_EQ(track["cpu_ms"]["max"], 1.0);

  const auto summary = nlohmann::json::parse(folder.read("summary.json"));
  EXPECT_EQ(summary["frames_in"], 100);
  EXPECT_EQ(summary["frames_out"], 98);
  EXPECT_EQ(summary["frames_unreliable"], 7);
  EXPECT_EQ(summary["queues"][0]["component"], "odometry");
  EXPECT_EQ(summary["queues"][0]["input"], "/stereo/left/image_rect");
  EXPECT_EQ(summary["queues"][0]["dropped"], 2);
  EXPECT_EQ(summary["cpu_s"], 1.5);
  EXPECT_EQ(summary["wall_s"], 10.0);
  EXPECT_EQ(summary["peak_memory_mb"], 120.5);
  EXPECT_EQ(summary["version"], "0.1.0");
  EXPECT_EQ(summary["seed"], 18446744073709551615U);
  EXPECT_EQ(summary["replay"], true);
  EXPECT_EQ(summary["changed_parameters"]["odometry"]["tracker.max_features"], "500");
  EXPECT_EQ(summary["exit_status"], 0);
}

TEST(RunFiles, SummaryTakesTextThatIsNotUtf8) {
  const TemporaryFolder folder;
  RunFiles files(folder.path());
  RunSummary summary;
  summary.system_file = "stereo\xff.yaml";
  files.finish(summary, {});
  EXPECT_EQ(nlohmann::json::parse(folder.read("summary.json"))["system_file"], "stereo\xef\xbf\xbd.yaml");
}

}  // namespace
}  // namespace panvo::runner
