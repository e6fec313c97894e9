// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "made_up_landmark.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/landmarks/landmark_messages.hpp"
#include "panvo/landmarks/landmark_store.hpp"
#include "panvo/runtime/testing.hpp"
#include "panvo/sqlite/database.hpp"
#include "panvo/test/temporary_folder.hpp"
#include "poses_message.hpp"

namespace panvo::landmarks {
namespace {

using namespace test;
using panvo::test::TemporaryFolder;
using testing::HasSubstr;
using testing::IsEmpty;

class LandmarkStoreComponent : public testing::Test {
 protected:
  /// One run of the component with its input topics.
  struct Session {
    runtime::ComponentHarness harness;
    const std::vector<std::shared_ptr<const panvo_msgs::msg::PanoramicLandmark>>& published =
        harness.collect(topics::kLandmarks);

    explicit Session(const std::string& file, bool read_only = false, int forget_after = 0) {
      harness.load("panvo_landmarks", "LandmarkStoreComponent",
                   {{"file", file},
                    {"read_only", read_only ? "true" : "false"},
                    {"forget_after", std::to_string(forget_after)}});
    }
    void publish(const PanoramicLandmark& landmark, const DescriptionSettings& settings = made_up_settings()) {
      harness.publish(topics::kLandmarks, to_message(landmark, settings, "map"));
    }
    void publish_poses(const std::vector<PanoramicLandmark>& landmarks) {
      harness.publish(topics::kLandmarkPoses, to_poses_message(landmarks));
    }
  };

  TemporaryFolder folder_;
  const std::string file_ = folder_ / "store";
};

TEST_F(LandmarkStoreComponent, KeepsWhatIsPublished) {
  {
    Session session(file_);
    EXPECT_FALSE(std::filesystem::exists(file_)) << "nothing to store yet";
    session.publish(made_up_landmark(1));
    session.publish(made_up_landmark(2));
  }
  const LandmarkStore store(file_);
  ASSERT_EQ(store.size(), 2U);
  EXPECT_EQ(store.settings(), made_up_settings());
  EXPECT_EQ(difference(store.landmarks()[1], made_up_landmark(2), false), "");
  EXPECT_EQ(store.keypoints(2), made_up_landmark(2).keypoints);
  EXPECT_EQ(store.thumbnail(2), made_up_landmark(2).thumbnail);
}

TEST_F(LandmarkStoreComponent, BeginsWithTheLandmarksOfEarlierSessionsAndGoesOn) {
  { Session(file_).publish(made_up_landmark(1)); }
  {
    Session session(file_);
    session.publish(made_up_landmark(2));
    ASSERT_EQ(session.published.size(), 2U);
    auto expected = made_up_landmark(1);
    expected.thumbnail.clear();
    const auto first = to_landmark(*session.published[0], made_up_settings());
    ASSERT_TRUE(first) << first.reason();
    EXPECT_EQ(difference(*first, expected), "");
    EXPECT_THAT(session.harness.log(), testing::Contains(HasSubstr("1 landmarks loaded")));
  }
  const LandmarkStore store(file_);
  EXPECT_EQ(store.size(), 2U);
  EXPECT_EQ(store.thumbnail(1), made_up_landmark(1).thumbnail) << "its own messages must not be stored again";
}

TEST_F(LandmarkStoreComponent, MovesALandmarkThatComesAgain) {
  Session session(file_);
  auto landmark = made_up_landmark(1);
  session.publish(landmark);
  landmark.map_from_base.translation().x() += 5.0;
  session.publish(landmark);
  const LandmarkStore store(file_);
  ASSERT_EQ(store.size(), 1U);
  EXPECT_EQ(difference(store.landmarks()[0], landmark, false), "");
}

PanoramicLandmark moved(PanoramicLandmark landmark, double by_m) {
  landmark.map_from_base.translation().x() += by_m;
  landmark.covariance *= 0.5;
  return landmark;
}

TEST_F(LandmarkStoreComponent, LetsTheNextSessionBeginWithTheStraightenedMap) {
  {
    Session session(file_);
    for (std::uint32_t id = 1; id <= 3; ++id) session.publish(made_up_landmark(id));
    session.publish_poses({moved(made_up_landmark(1), 2.0), moved(made_up_landmark(3), -3.0)});
    session.publish_poses({moved(made_up_landmark(1), 4.0), moved(made_up_landmark(3), -3.0)});
  }
  const Session next(file_);
  ASSERT_EQ(next.published.size(), 3U);
  const std::vector<PanoramicLandmark> expected{moved(made_up_landmark(1), 4.0), made_up_landmark(2),
                                                moved(made_up_landmark(3), -3.0)};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto published = to_landmark(*next.published[i], made_up_settings());
    ASSERT_TRUE(published) << published.reason();
    EXPECT_TRUE(published->map_from_base.isApprox(expected[i].map_from_base, 1e-12)) << i + 1;
    EXPECT_TRUE(published->covariance.isApprox(expected[i].covariance, 1e-12)) << i + 1;
  }
}

/// A landmark at x on a road, built on that day.
PanoramicLandmark on_road(std::uint32_t id, double x_m, int day) {
  auto landmark = made_up_landmark(id);
  landmark.map_from_base = Eigen::Isometry3d::Identity();
  landmark.map_from_base.translation().x() = x_m;
  landmark.stamp_ns += day * 86'400'000'000'000;
  return landmark;
}

/// A drive along the road on which these landmarks are recognised.
void drive(runtime::ComponentHarness& harness, double to_m, const std::map<std::uint32_t, double>& recognised_at,
           double from_m = 0.0) {
  std::set<std::uint32_t> seen;
  for (double x = from_m; x <= to_m; x += 1.0) {
    nav_msgs::msg::Odometry odometry;
    odometry.header().frame_id("map");
    odometry.pose().pose().position().x(x);
    odometry.pose().pose().orientation().w(1.0);
    for (int i = 0; i < 6; ++i) odometry.pose().covariance()[static_cast<std::size_t>(7 * i)] = 0.01;
    harness.publish(topics::kOdometryEnhanced, odometry);
    for (const auto& [id, at_m] : recognised_at) {
      if (x < at_m || !seen.insert(id).second) continue;
      panvo_msgs::msg::CorrectionOutcome outcome;
      outcome.landmark_id(id);
      outcome.outcome(panvo_msgs::msg::CorrectionOutcome_Constants::APPLIED);
      outcome.before().orientation().w(1.0);
      outcome.after().orientation().w(1.0);
      harness.publish(topics::kCorrectionOutcome, outcome);
    }
  }
}

TEST_F(LandmarkStoreComponent, CountsWhichLandmarksAreRecognised) {
  {
    Session session(file_);
    session.publish(on_road(1, 50.0, 0));
    session.publish(on_road(2, 100.0, 0));
    drive(session.harness, 200.0, {{1, 50.0}});
  }
  EXPECT_THAT(LandmarkStore(file_).uses(), testing::ElementsAre(testing::Pair(1U, LandmarkUse{1, 1, 1, 0, 0}),
                                                                testing::Pair(2U, LandmarkUse{1, 1, 0, 1, 0})));
}

TEST_F(LandmarkStoreComponent, KeepsAnotherAppearanceWhereAPlaceWasMissedOnFourDrives) {
  {
    Session session(file_);
    session.publish(on_road(1, 50.0, 0));
    session.publish(on_road(2, 100.0, 0));
  }
  for (int day = 1; day <= 4; ++day) {
    Session session(file_);
    drive(session.harness, 200.0, {{1, 50.0}});
    session.publish(on_road(3, 101.0, day));
    EXPECT_EQ(LandmarkStore(file_).size(), day < 4 ? 2U : 3U) << "day " << day;
  }
  EXPECT_EQ(LandmarkStore(file_).uses().at(3).session, 2U);
}

TEST_F(LandmarkStoreComponent, KeepsAnotherAppearanceOnTheSecondDriveOnWhichAllLooksDifferent) {
  {
    Session session(file_);
    for (std::uint32_t id = 1; id <= 7; ++id) session.publish(on_road(id, 50.0 * id, 0));
  }
  for (int day = 1; day <= 2; ++day) {
    Session session(file_);
    drive(session.harness, 349.0, {});
    session.publish(on_road(8, 349.0, day));
    EXPECT_EQ(LandmarkStore(file_).size(), day == 1 ? 7U : 8U) << "day " << day;
    drive(session.harness, 400.0, {});
  }
}

TEST_F(LandmarkStoreComponent, CountsNoMissOfALandmarkThatWasJustBuilt) {
  Session session(file_);
  drive(session.harness, 50.0, {});
  session.publish(on_road(1, 50.0, 0));
  drive(session.harness, 100.0, {}, 51.0);
  EXPECT_EQ(LandmarkStore(file_).uses().at(1), (LandmarkUse{1, 0, 0, 0, 0}));
}

TEST_F(LandmarkStoreComponent, KeepsAllPlacesOfAStereoCamera) {
  auto settings = made_up_settings();
  settings["camera"] = "stereo";
  for (std::uint32_t id = 1; id <= 6; ++id) {
    Session session(file_);
    session.publish(on_road(id, 50.0 + id, static_cast<int>(id)), settings);
    drive(session.harness, 200.0, {});
  }
  EXPECT_EQ(LandmarkStore(file_).size(), 6U);
  EXPECT_THAT(LandmarkStore(file_).uses(), IsEmpty());
}

TEST_F(LandmarkStoreComponent, ForgetsALandmarkThatIsGone) {
  {
    LandmarkStore store(file_, made_up_settings());
    for (const std::uint32_t id : {1U, 2U}) store.add(on_road(id, 50.0 * id, 0));
    store.set_uses({{1, {1, 30, 25, 5, 0}}, {2, {1, 12, 2, 10, 10}}});
  }
  EXPECT_EQ(Session(file_).published.size(), 2U) << "0: nothing is removed";
  const Session session(file_, false, 10);
  ASSERT_EQ(session.published.size(), 1U);
  EXPECT_EQ(session.published[0]->id(), 1U);
  EXPECT_TRUE(session.harness.log_contains("1 landmarks removed"));
  EXPECT_EQ(LandmarkStore(file_).size(), 1U);
  EXPECT_EQ(LandmarkStore(file_).uses().size(), 1U);
  EXPECT_EQ(LandmarkStore(file_).keypoints(2).size(), 0U);
}

TEST_F(LandmarkStoreComponent, CountsInAStoreOfAnEarlierVersion) {
  {
    LandmarkStore store(file_, made_up_settings());
    store.add(on_road(1, 50.0, 0));
  }
  EXPECT_THAT(LandmarkStore(file_).uses(), IsEmpty());
  {
    Session session(file_);
    drive(session.harness, 100.0, {});
  }
  EXPECT_EQ(LandmarkStore(file_).uses().at(1).missed, 1U);
}

TEST_F(LandmarkStoreComponent, GoesOnCountingWhereSessionsWereNotCountedYet) {
  {
    LandmarkStore store(file_, made_up_settings());
    store.add(on_road(1, 50.0, 0));
  }
  sqlite::Database(file_, sqlite::Database::Mode::kReadWrite)
      .execute(
          "CREATE TABLE landmark_use(landmark_id INTEGER PRIMARY KEY, passes INTEGER NOT NULL, recognitions INTEGER "
          "NOT "
          "NULL, missed INTEGER NOT NULL, missed_in_company INTEGER NOT NULL); INSERT INTO landmark_use "
          "VALUES(1,3,1,2,1);");
  EXPECT_EQ(LandmarkStore(file_).uses().at(1), (LandmarkUse{0, 3, 1, 2, 1}));
  {
    Session session(file_);
    session.publish(on_road(2, 100.0, 1));
    drive(session.harness, 200.0, {{1, 50.0}});
  }
  EXPECT_EQ(LandmarkStore(file_).uses().at(1), (LandmarkUse{0, 4, 2, 0, 0}));
  EXPECT_EQ(LandmarkStore(file_).uses().at(2), (LandmarkUse{1, 1, 0, 1, 0}));
}

TEST_F(LandmarkStoreComponent, MovesALandmarkThatComesAfterItsPose) {
  Session session(file_);
  session.publish_poses({moved(made_up_landmark(1), 2.0)});
  EXPECT_FALSE(std::filesystem::exists(file_)) << "a pose alone must not create a store";
  session.publish(made_up_landmark(1));
  EXPECT_TRUE(
      LandmarkStore(file_).landmarks()[0].map_from_base.isApprox(moved(made_up_landmark(1), 2.0).map_from_base, 1e-12));
}

TEST_F(LandmarkStoreComponent, MovesNothingByAMalformedMessageAndSaysWhy) {
  Session session(file_);
  session.publish(made_up_landmark(1));
  panvo_msgs::msg::LandmarkPoses message;
  message.ids({1});
  session.harness.publish(topics::kLandmarkPoses, message);
  EXPECT_TRUE(session.harness.log_contains("was dropped: poses differ in number from ids"));
  auto broken = made_up_landmark(1);
  broken.covariance(2, 2) = -1.0;
  session.publish_poses({broken});
  EXPECT_TRUE(session.harness.log_contains("was dropped: poses.covariance has a negative variance"));
  EXPECT_EQ(difference(LandmarkStore(file_).landmarks()[0], made_up_landmark(1), false), "");
}

TEST_F(LandmarkStoreComponent, MovesNothingInAStoreThatIsToBeRead) {
  { Session(file_).publish(made_up_landmark(1)); }
  const auto before = folder_.read(file_);
  Session session(file_, true);
  session.publish_poses({moved(made_up_landmark(1), 2.0)});
  EXPECT_EQ(folder_.read(file_), before);
}

TEST_F(LandmarkStoreComponent, KeepsNothingOfOtherSettingsAndSaysWhatDiffers) {
  Session session(file_);
  session.publish(made_up_landmark(1));
  session.publish(made_up_landmark(2), {{"band_rows", "150"}, {"seed", "2"}});
  EXPECT_TRUE(session.harness.log_contains("error landmarks: " + file_ +
                                           ": its landmarks were described with other settings: "
                                           "seed is 1 there, 2 here"));
  EXPECT_EQ(LandmarkStore(file_).size(), 1U);
}

TEST_F(LandmarkStoreComponent, LeavesAStoreAloneThatIsToBeRead) {
  { Session(file_).publish(made_up_landmark(1)); }
  const auto before = folder_.read(file_);
  Session session(file_, true);
  session.publish(made_up_landmark(2));
  EXPECT_EQ(session.published.size(), 2U);
  EXPECT_EQ(folder_.read(file_), before);
}

TEST_F(LandmarkStoreComponent, LeavesOutAMalformedLandmarkAndSaysWhy) {
  Session session(file_);
  auto message = to_message(made_up_landmark(1), made_up_settings(), "map");
  message.histogram().clear();
  session.harness.publish(topics::kLandmarks, message);
  EXPECT_TRUE(session.harness.log_contains("was dropped: histogram is empty"));
  session.publish(made_up_landmark(2));
  EXPECT_EQ(LandmarkStore(file_).size(), 1U);
}

TEST_F(LandmarkStoreComponent, BeginsWithTheOtherLandmarksWhereOneIsNone) {
  {
    LandmarkStore store(file_, made_up_settings());
    for (const std::uint32_t id : {1U, 2U, 3U}) store.add(made_up_landmark(id));
  }
  sqlite::Database(file_, sqlite::Database::Mode::kReadWrite)
      .execute(
          "UPDATE landmark SET small_features = x'ffff0000000000003f000000003f' WHERE id = 1;"
          "UPDATE keypoints SET data = x'00' WHERE landmark_id = 2;");

  const Session session(file_);
  ASSERT_EQ(session.published.size(), 1U);
  EXPECT_EQ(session.published[0]->id(), 3U);
  EXPECT_TRUE(session.harness.log_contains("landmark 1: small_features"));
  EXPECT_TRUE(session.harness.log_contains("landmark 2: keypoints are truncated"));
}

TEST_F(LandmarkStoreComponent, KeepsNewLandmarksThatHaveTheIdsOfOneThatIsNone) {
  {
    LandmarkStore store(file_, made_up_settings());
    for (const std::uint32_t id : {1U, 2U, 3U}) store.add(made_up_landmark(id));
  }
  sqlite::Database(file_, sqlite::Database::Mode::kReadWrite)
      .execute("UPDATE keypoints SET data = x'00' WHERE landmark_id = 3");
  auto third = made_up_landmark(30), fourth = made_up_landmark(40);
  third.id = 3;  // those who number landmarks have not heard of the damaged one
  fourth.id = 4;
  {
    Session session(file_);
    ASSERT_EQ(session.published.size(), 2U);
    session.publish(third);
    session.publish(fourth);
    session.publish_poses({moved(third, 2.0)});
    EXPECT_FALSE(session.harness.log_contains("No more landmarks will be stored"));
  }
  const LandmarkStore store(file_);
  const auto stored = store.landmarks();
  ASSERT_EQ(stored.size(), 5U);
  third.id = 4;
  fourth.id = 5;
  EXPECT_EQ(difference(stored[2], made_up_landmark(3), false), "") << "to be restored";
  EXPECT_EQ(difference(stored[3], moved(third, 2.0), false), "");
  EXPECT_EQ(difference(stored[4], fourth, false), "");
  EXPECT_EQ(store.keypoints(5), fourth.keypoints);
}

TEST_F(LandmarkStoreComponent, IsRefusedWithAFileThatIsNone) {
  folder_.write(file_, "a letter to somebody, longer than the header of a database would be, whatever that may be");
  EXPECT_THAT(error_of<std::runtime_error>([&] { const Session session(file_); }),
              HasSubstr("store: is not a landmark store"));
}

TEST_F(LandmarkStoreComponent, KeepsNothingWithoutAFileAndSaysSo) {
  Session session("");
  session.publish(made_up_landmark(1));
  EXPECT_TRUE(session.harness.log_contains("will not be saved"));
}

}  // namespace
}  // namespace panvo::landmarks
