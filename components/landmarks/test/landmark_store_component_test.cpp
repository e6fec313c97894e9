// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "made_up_landmark.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/landmarks/landmark_messages.hpp"
#include "panvo/landmarks/landmark_store.hpp"
#include "panvo/runtime/testing.hpp"
#include "panvo/sqlite/database.hpp"
#include "panvo/test/temporary_folder.hpp"

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

    explicit Session(const std::string& file, bool read_only = false) {
      harness.load("panvo_landmarks", "LandmarkStoreComponent",
                   {{"file", file}, {"read_only", read_only ? "true" : "false"}});
    }
    void publish(const PanoramicLandmark& landmark, const DescriptionSettings& settings = made_up_settings()) {
      harness.publish(topics::kLandmarks, to_message(landmark, settings, "map"));
    }
    void publish_poses(const std::vector<PanoramicLandmark>& landmarks) {
      panvo_msgs::msg::LandmarkPoses message;
      for (const auto& landmark : landmarks) {
        const auto whole = to_message(landmark, made_up_settings(), "map");
        message.ids().push_back(landmark.id);
        message.poses().push_back(whole.pose());
      }
      harness.publish(topics::kLandmarkPoses, message);
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
