// SPDX-License-Identifier: Apache-2.0
/// Tests the command line of panvo_landmarks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "made_up_landmark.hpp"
#include "panvo/landmarks/landmark_store.hpp"
#include "panvo/landmarks/panorama_describer.hpp"
#include "panvo/postgres/connection.hpp"
#include "panvo/sqlite/database.hpp"
#include "panvo/test/postgres_server.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::landmarks {
namespace {

using namespace test;
using panvo::test::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;

struct Finished {
  int status = -1;
  std::string output;  // stdout and stderr
};

Finished run(const std::string& arguments) {
  Finished finished;
  std::FILE* pipe = ::popen((std::string(PANVO_LANDMARKS) + " " + arguments + " 2>&1").c_str(), "r");
  char part[4096];
  while (std::fgets(part, sizeof part, pipe)) finished.output += part;
  finished.status = WEXITSTATUS(::pclose(pipe));
  return finished;
}

class Command : public testing::Test {
 protected:
  void SetUp() override {
    write(store_, {1, 2, 3});
    write(other_, {7, 8});
  }
  /// Landmarks with these numbers, and one more 2 m from the first.
  void write(const std::string& file, const std::vector<std::uint32_t>& numbers) {
    LandmarkStore store(file, settings_);
    std::uint32_t id = 0;
    for (const auto number : numbers) {
      auto landmark = made_up_landmark(number, 300);
      landmark.id = ++id;
      store.add(landmark);
    }
    auto again = made_up_landmark(100, 300);
    again.map_from_base = made_up_landmark(numbers.front()).map_from_base;
    again.map_from_base.translation().x() += 2.0;
    again.id = ++id;
    store.add(again);
  }

  TemporaryFolder folder_;
  const DescriptionSettings settings_ = description_settings(DescriptionParameters{}, 5);
  const std::string store_ = folder_ / "store", other_ = folder_ / "other", out_ = folder_ / "out";
};

TEST_F(Command, InfoTellsWhatIsInAStore) {
  const auto finished = run("info " + store_);
  EXPECT_EQ(finished.status, 0);
  for (const char* part :
       {"Landmarks:     4, ", "100 large features, 100 small, 300 keypoints;", "keypoints     45900 bytes",
        "large          1400 bytes", "histogram       256 bytes", "First, last:   1700000010.000000001, ", "seed = 5\n",
        "Close pairs:   landmarks 1 and 4 are 2.00 m apart\n", "Extent:        x "}) {
    EXPECT_THAT(finished.output, HasSubstr(part));
  }
}

TEST_F(Command, InfoTellsItToScripts) {
  const auto json = nlohmann::json::parse(run("info --json " + store_).output);
  EXPECT_EQ(json["landmarks"], 4);
  EXPECT_EQ(json["keypoints"], 1200);
  EXPECT_EQ(json["bytes_per_landmark"]["keypoints"], 45900.0);
  EXPECT_EQ(json["file_bytes"], std::filesystem::file_size(store_));
  EXPECT_EQ(json["settings"]["seed"], "5");
  EXPECT_EQ(json["close"].size(), 1u);
  EXPECT_EQ(json["close"][0]["second"], 4);
  EXPECT_EQ(json["first_stamp_ns"], made_up_landmark(1).stamp_ns);
  EXPECT_TRUE(json["damage"].is_null());
}

TEST_F(Command, InfoToScriptsIsUtf8WhateverTheFileIsCalled) {
  const auto file = (folder_ / "caf\xe9").string();  // Latin-1
  write(file, {1});
  EXPECT_THAT(std::string(nlohmann::json::parse(run("info --json " + file).output)["store"]),
              testing::EndsWith("caf\xef\xbf\xbd"));
}

TEST_F(Command, InfoOfAnEmptyStoreHasNoExtent) {
  { LandmarkStore empty(folder_ / "empty", settings_); }
  EXPECT_THAT(run("info " + (folder_ / "empty").string()).output, HasSubstr("Landmarks:     0, 0 of them"));
  EXPECT_TRUE(
      nlohmann::json::parse(run("info --json " + (folder_ / "empty").string()).output)["first_stamp_ns"].is_null());
}

TEST_F(Command, InfoWithCheckEndsWithOneForADamagedStore) {
  EXPECT_EQ(run("info --check " + store_).status, 0);
  auto damaged = folder_.read(store_);
  std::fill(damaged.begin() + static_cast<std::ptrdiff_t>(damaged.size() / 2), damaged.end() - 5000, '\0');
  folder_.write(store_, damaged);
  const auto finished = run("info --check " + store_);
  EXPECT_EQ(finished.status, 1);
  EXPECT_THAT(finished.output, HasSubstr("Damaged:"));
}

TEST_F(Command, MergeRenumbersAndKeepsEverything) {
  const auto finished = run("merge " + store_ + " " + other_ + " --out " + out_);
  EXPECT_EQ(finished.status, 0) << finished.output;
  EXPECT_THAT(finished.output, HasSubstr("store: 4 landmarks, now 1 to 4\n"));
  EXPECT_THAT(finished.output, HasSubstr("other: 3 landmarks, now 5 to 7\n"));
  EXPECT_THAT(finished.output, HasSubstr("out: 7 landmarks; 2 pairs are closer than 3 m"));
  const LandmarkStore merged(out_);
  EXPECT_EQ(merged.size(), 7u);
  auto expected = made_up_landmark(7, 300);
  expected.id = 5;
  EXPECT_EQ(difference(merged.landmarks().at(4), expected, false), "");
  EXPECT_EQ(merged.keypoints(5), expected.keypoints);
  EXPECT_EQ(merged.thumbnail(5), expected.thumbnail);
  EXPECT_FALSE(std::filesystem::exists(out_ + ".unfinished"));
}

TEST_F(Command, MergeRefusesOtherSettingsAndLeavesNothingBehind) {
  { LandmarkStore foreign(folder_ / "foreign", description_settings(DescriptionParameters{}, 6)); }
  const auto finished = run("merge " + store_ + " " + (folder_ / "foreign").string() + " --out " + out_);
  EXPECT_EQ(finished.status, 2);
  EXPECT_THAT(finished.output,
              HasSubstr("foreign: its landmarks were described with other settings: seed is 6 there, 5 here"));
  EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(Command, MergeThatFailsHalfWayLosesNothing) {
  const auto before = folder_.read(store_);
  folder_.write(out_, folder_.read(other_));
  auto damaged = folder_.read(other_);
  std::fill(damaged.begin() + static_cast<std::ptrdiff_t>(damaged.size() / 2), damaged.end() - 3000, '\0');
  folder_.write(other_, damaged);
  const auto finished = run("merge --overwrite " + store_ + " " + other_ + " --out " + out_);
  EXPECT_EQ(finished.status, 2) << finished.output;
  EXPECT_THAT(finished.output, HasSubstr("other: is damaged"));
  EXPECT_EQ(LandmarkStore(out_).size(), 3u) << "the store to be replaced must be unchanged";
  EXPECT_EQ(folder_.read(store_), before);
  EXPECT_FALSE(std::filesystem::exists(out_ + ".unfinished"));
}

TEST_F(Command, MergeReplacesOnlyStoresAndOnlyWhenTold) {
  folder_.write(out_, "precious");
  EXPECT_THAT(run("merge " + store_ + " " + other_ + " --out " + out_).output, HasSubstr("out: already exists"));
  EXPECT_EQ(run("merge --overwrite " + store_ + " " + other_ + " --out " + out_).status, 2);
  EXPECT_EQ(folder_.read(out_), "precious");
  EXPECT_EQ(run("merge --overwrite " + store_ + " " + other_ + " --out " + store_).status, 0)
      << "replacing one of the inputs";
  EXPECT_EQ(LandmarkStore(store_).size(), 7u);
}

TEST_F(Command, MergeBeginsAnewWhereOneWasKilled) {
  { LandmarkStore left(out_ + ".unfinished", settings_); }
  EXPECT_EQ(run("merge " + store_ + " " + other_ + " --out " + out_).status, 0);
  EXPECT_EQ(LandmarkStore(out_).size(), 7u);
}

TEST_F(Command, CopyKeepsIdsAndRefusesWhatIsThereAlready) {
  const auto finished = run("copy " + other_ + " " + out_);
  EXPECT_EQ(finished.status, 0) << finished.output;
  EXPECT_EQ(finished.output, other_ + ": 3 landmarks copied to " + out_ + " and compared\n");
  EXPECT_EQ(difference(LandmarkStore(out_).landmarks().at(2), LandmarkStore(other_).landmarks().at(2)), "");
  EXPECT_EQ(run("copy " + store_ + " " + out_).status, 2);
  EXPECT_EQ(LandmarkStore(out_).size(), 3u);
  EXPECT_EQ(run("copy --overwrite " + store_ + " " + out_).status, 0);
  EXPECT_EQ(LandmarkStore(out_).size(), 4u);
  EXPECT_FALSE(std::filesystem::exists(out_ + ".unfinished"));
}

TEST_F(Command, CopyOfADamagedStoreLeavesNothingBehindUnlessToldToLeaveThatOut) {
  sqlite::Database(store_, sqlite::Database::Mode::kReadWrite).execute("UPDATE landmark SET x = 1e200 WHERE id = 2");
  auto finished = run("copy " + store_ + " " + out_);
  EXPECT_EQ(finished.status, 2);
  EXPECT_THAT(finished.output, HasSubstr("store: is damaged: landmark 2: pose.pose.position is beyond"));
  EXPECT_FALSE(std::filesystem::exists(out_));
  finished = run("copy --skip-damaged " + store_ + " " + out_);
  EXPECT_EQ(finished.status, 1);
  EXPECT_THAT(finished.output, HasSubstr("landmark 2: pose.pose.position is beyond +-1e+08; left out"));
  EXPECT_EQ(LandmarkStore(out_).size(), 3u);
}

TEST_F(Command, TellsThatAServerIsAwayWithoutThePassword) {
  const std::string away = "'postgresql://robot:opensesame@/map?host=" + folder_.path().string() + "'";
  for (const auto& arguments : {"info " + away, "copy " + away + " " + out_, "copy " + store_ + " " + away,
                                "merge " + store_ + " " + away + " --out " + out_}) {
    const auto finished = run(arguments);
    EXPECT_EQ(finished.status, 2) << arguments;
    EXPECT_THAT(finished.output, HasSubstr("panvo landmarks: postgresql://robot@/map?host="));
    EXPECT_THAT(finished.output, testing::AnyOf(HasSubstr("cannot be reached"), HasSubstr("install libpq-dev")));
    EXPECT_THAT(finished.output, Not(HasSubstr("sesame")));
  }
  EXPECT_THAT(run("merge " + store_ + " " + other_ + " --out " + away).output,
              HasSubstr("stores are merged into a file; then use panvo landmarks copy"));
}

/// The command line with a server.
class ServerCommand : public Command {
 protected:
  void SetUp() override {
    if (!postgres::is_available()) GTEST_SKIP() << "built without libpq; install libpq-dev";
    PANVO_SKIP_WITHOUT_POSTGRES();
    Command::SetUp();
    server_ = &panvo::test::PostgresServer::shared();
    server_->sql("postgres", "CREATE DATABASE " + database_);
  }
  std::string quoted() const { return "'" + server_->location(database_) + "'"; }

  panvo::test::PostgresServer* server_ = nullptr;
  const std::string database_ = "map" + std::to_string(++databases_);

 private:
  static inline int databases_ = 0;
};

TEST_F(ServerCommand, CopiesAFileToAServerAndBack) {
  auto finished = run("copy " + store_ + " " + quoted());
  EXPECT_EQ(finished.status, 0) << finished.output;
  EXPECT_THAT(finished.output, HasSubstr("store: 4 landmarks copied to postgresql:///" + database_));
  finished = run("copy " + quoted() + " " + out_);
  EXPECT_EQ(finished.status, 0) << finished.output;
  const LandmarkStore original(store_), copy(out_);
  EXPECT_EQ(copy.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(difference(copy.landmarks().at(i), original.landmarks().at(i)), "");
    const auto id = static_cast<std::uint32_t>(i + 1);
    EXPECT_EQ(copy.keypoints(id), original.keypoints(id));
    EXPECT_EQ(copy.thumbnail(id), original.thumbnail(id));
  }
  EXPECT_EQ(run("copy " + other_ + " " + quoted()).status, 2) << "already contains landmarks";
  EXPECT_EQ(run("copy --overwrite " + other_ + " " + quoted()).status, 0);
  EXPECT_EQ(LandmarkStore(server_->location(database_)).size(), 3u);
}

TEST_F(ServerCommand, InspectsDrawsAndMergesAServersLandmarks) {
  ASSERT_EQ(run("copy " + store_ + " " + quoted()).status, 0);
  const auto info = run("info --check " + quoted());
  EXPECT_EQ(info.status, 0) << info.output;
  EXPECT_THAT(info.output, HasSubstr("Landmarks:     4, "));
  EXPECT_THAT(info.output, HasSubstr("Close pairs:   landmarks 1 and 4 are 2.00 m apart\n"));
  EXPECT_EQ(run("show " + quoted() + " --out " + (folder_ / "pictures").string() + " --id 2").status, 0);
  EXPECT_EQ(run("merge " + other_ + " " + quoted() + " --out " + out_).status, 0);
  EXPECT_EQ(LandmarkStore(out_).size(), 7u);
  server_->sql(database_, "UPDATE panvo.landmark SET x = 1e200 WHERE id = 2");
  EXPECT_EQ(run("info --check " + quoted()).status, 1);
}

TEST_F(Command, ShowDrawsTheMapAndTheLandmarksAskedFor) {
  const auto finished = run("show " + store_ + " --out " + out_ + " --id 2 --id 4");
  EXPECT_EQ(finished.status, 0) << finished.output;
  EXPECT_THAT(finished.output, HasSubstr("map.png and 2 landmarks drawn"));
  EXPECT_FALSE(cv::imread(out_ + "/map.png").empty());
  EXPECT_FALSE(cv::imread(out_ + "/landmark_0002.png").empty());
  EXPECT_FALSE(cv::imread(out_ + "/landmark_0004.png").empty());
  EXPECT_FALSE(std::filesystem::exists(out_ + "/landmark_0001.png"));
}

// [Lu2015 Fig. 3]: red rectangles for intensity, blue for SURF statistics, at the positions in the matrix.
TEST_F(Command, ShowDrawsRectanglesRedForIntensityAndBlueForSurf) {
  const PanoramaDescriber describer(DescriptionParameters{}, 5);
  const auto& basis = describer.basis();
  const auto rows = static_cast<std::uint16_t>(basis.large.rows());
  auto landmark = made_up_landmark(1);
  landmark.description.large = {{3, 0.0f, 1.0f, 0.9f}};
  landmark.description.small = {{static_cast<std::uint16_t>(rows + 3), 0.0f, 1.0f, 0.9f}};
  landmark.thumbnail.clear();
  LandmarkStore(folder_ / "one", settings_).add(landmark);
  ASSERT_EQ(run("show " + (folder_ / "one").string() + " --out " + out_).status, 0);
  const cv::Mat picture = cv::imread(out_ + "/landmark_0001.png");
  ASSERT_EQ(picture.cols, 1080);
  const int title = picture.rows / 2 - 540;
  const auto middle_of_left_edge = [&](const vision::MeasurementMatrix& matrix, int panel) {
    const auto& rectangle = matrix.row(3).front().rectangle;
    const int row = panel * (540 + title) + title + basis.first_row + rectangle.y + rectangle.height / 2;
    return picture.at<cv::Vec3b>(row, rectangle.x);
  };
  const auto intensity = middle_of_left_edge(basis.large, 0);
  EXPECT_GT(intensity[2], intensity[0] + 100) << "red";
  const auto surf = middle_of_left_edge(basis.small, 1);
  EXPECT_GT(surf[0], surf[2] + 100) << "blue";
}

TEST_F(Command, EndsWithTwoAndANameWhereItCannotBeDone) {
  const auto finished = run("info " + (folder_ / "none").string());
  EXPECT_EQ(finished.status, 2);
  EXPECT_THAT(finished.output, HasSubstr("panvo landmarks: "));
  EXPECT_THAT(finished.output, HasSubstr("none: does not exist"));
  EXPECT_THAT(run("show " + store_ + " --out " + out_ + " --id 9").output, HasSubstr("store: has no landmark 9"));
  EXPECT_EQ(run("show " + store_).status, 2);
  EXPECT_EQ(run("merge " + store_ + " --out " + out_).status, 2);
  EXPECT_EQ(run("inform " + store_).status, 2);
  EXPECT_EQ(run("--help").status, 0);
  { LandmarkStore foreign(folder_ / "foreign", made_up_settings()); }
  EXPECT_THAT(run("show " + (folder_ / "foreign").string() + " --out " + out_).output,
              HasSubstr("foreign: its settings do not match this version of panvo"));
}

}  // namespace
}  // namespace panvo::landmarks
