// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

#include "corrector_on_topics.hpp"
#include "panvo/landmarks/panorama_level.hpp"
#include "panvo/vision/equirectangular.hpp"

namespace panvo::position_corrector {
namespace {

class PaperPositionCorrector : public CorrectorOnTopics {
 protected:
  PaperPositionCorrector() : CorrectorOnTopics({{"correction.method", "paper"}}) {}
};

TEST_F(CorrectorOnTopics, TellsOfEachPanoramaWhatItShows) {
  publish_landmark(1, 1);
  publish_landmark(2, 2);
  publish_odometry(200.0, 1.0);
  publish_panorama(place(80));
  publish_panorama(turned(place(2), 270));
  ASSERT_EQ(matches.size(), 2U);
  EXPECT_NE(matches[0]->state(), panvo_msgs::msg::LandmarkMatch_Constants::LOCKED);
  EXPECT_FALSE(matches[0]->reason().empty());
  EXPECT_EQ(matches[1]->state(), panvo_msgs::msg::LandmarkMatch_Constants::LOCKED) << matches[1]->reason();
  EXPECT_EQ(matches[1]->landmark_id(), 2U);
  EXPECT_EQ(matches[1]->candidates(), 1U);
  EXPECT_NEAR(matches[1]->heading_rad(), M_PI / 2.0, 0.01);
  EXPECT_EQ(conversions::to_ns(matches[1]->header().stamp()), 2 * kPeriod_ns);
  EXPECT_EQ(matches[1]->header().frame_id(), "panorama");
}

TEST_F(CorrectorOnTopics, RecognisesAPlaceAtAnotherHeadingWithACameraThatIsMountedAtATilt) {
  publish_landmark(2, 2);
  Eigen::Isometry3d tilted = mounted(2.0);
  tilted.linear() = vision::so3_exp({0.09, 0.26, 0.0}) * tilted.linear();  // 5 degrees to the right, 15 down
  tf2_msgs::msg::TFMessage message;
  message.transforms().push_back(conversions::to_static_transform(0, "base_link", "panorama", tilted));
  harness.publish(topics::kTfStatic, message);

  const cv::Mat upright = turned(place(2), 270);
  const vision::Equirectangular sphere{upright.cols, upright.rows};
  const Eigen::Matrix3d level_from_tilted = landmarks::PanoramaLevel(tilted).panorama_from_level().transpose();
  cv::Mat_<cv::Point2f> where(upright.size());
  for (int row = 0; row < where.rows; ++row) {
    for (int column = 0; column < where.cols; ++column) {
      const auto pixel = sphere.project(level_from_tilted * sphere.unproject({column, row}));
      where(row, column) = {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
    }
  }
  cv::Mat panorama;
  cv::remap(upright, panorama, where, {}, cv::INTER_LINEAR, cv::BORDER_WRAP);

  publish_odometry(200.0, 1.0);
  publish_panorama(panorama);
  ASSERT_EQ(matches.size(), 1U);
  ASSERT_EQ(matches[0]->state(), panvo_msgs::msg::LandmarkMatch_Constants::LOCKED) << matches[0]->reason();
  EXPECT_NEAR(matches[0]->heading_rad(), M_PI / 2.0, 0.02);
  ASSERT_EQ(corrections.size(), 1U);
  const auto seen = conversions::to_isometry(corrections[0]->landmark_from_base().pose());
  ASSERT_TRUE(seen);
  const Eigen::Matrix3d expected = vision::so3_exp({0.0, 0.0, M_PI / 2.0});
  EXPECT_LT(Eigen::AngleAxisd(seen->linear().transpose() * expected).angle(), 0.02) << "the vehicle is level";
}

TEST_F(CorrectorOnTopics, SearchesEverythingWithoutOdometryAndSaysSo) {
  publish_landmark(1, 1);
  publish_landmark(2, 2);
  publish_panorama(place(1));
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_EQ(matches[0]->candidates(), 2U);
  EXPECT_EQ(matches[0]->landmark_id(), 1U);
  EXPECT_TRUE(harness.log_contains("the whole library is searched"));
}

TEST_F(CorrectorOnTopics, LeavesOutALandmarkThatWasDescribedOtherwise) {
  auto parameters = landmarks::DescriptionParameters{};
  parameters.top_deg = 45.0;
  publish_landmark(1, 1, landmarks::landmark_settings(parameters, {}, 1));
  publish_panorama(place(1));
  EXPECT_TRUE(harness.log_contains("top_deg"));
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_EQ(matches[0]->reason(), "no landmarks yet");
}

/// Unchecked, each of them would crash the process or the component.
TEST_F(CorrectorOnTopics, LeavesOutLandmarksThatNoMatrixHereCouldDescribe) {
  const auto settings = landmarks::landmark_settings({}, {}, 1);
  auto landmark = landmark_of(place(2), describer, Eigen::Vector3d(200.0, 0.0, 0.0));
  landmark.id = 2;
  for (const std::uint16_t row : {800, 65535}) {
    for (auto* features : {&landmark.description.large, &landmark.description.small}) {
      auto broken = landmark;
      (features == &landmark.description.large ? broken.description.large : broken.description.small)[0].row = row;
      harness.publish(topics::kLandmarks, to_message(broken, settings, "map"));
    }
  }
  auto broken = landmark;
  broken.description.histogram = {1.0F};
  harness.publish(topics::kLandmarks, to_message(broken, settings, "map"));
  publish_odometry(200.0, 1.0);
  publish_panorama(place(2));
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_EQ(matches[0]->candidates(), 0U);
  EXPECT_TRUE(harness.log_contains("large_features.row is not a row of the measurement matrix"));
  EXPECT_TRUE(harness.log_contains("histogram does not have as many bins as the settings specify"));
  EXPECT_TRUE(harness.container().run().empty());
}

TEST_F(CorrectorOnTopics, SaysThatAPanoramaIsOfNoUse) {
  publish_landmark(1, 1);
  publish_panorama(cv::Mat(540, 1080, CV_8UC1, cv::Scalar(0)));
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_EQ(matches[0]->state(), panvo_msgs::msg::LandmarkMatch_Constants::UNUSABLE);
  EXPECT_TRUE(harness.log_contains("panorama/image"));
}

TEST_F(CorrectorOnTopics, UsesNoPanoramaThatIsTheLastAgainOrUpsideDown) {
  has_noise = false;
  publish_landmark(2, 2);
  publish_panorama(place(2));
  publish_panorama(place(2));
  cv::Mat turned_over;
  cv::flip(place(2), turned_over, -1);
  publish_panorama(turned_over);
  ASSERT_EQ(matches.size(), 3U);
  EXPECT_NE(matches[0]->state(), panvo_msgs::msg::LandmarkMatch_Constants::UNUSABLE) << matches[0]->reason();
  EXPECT_EQ(matches[1]->state(), panvo_msgs::msg::LandmarkMatch_Constants::UNUSABLE);
  EXPECT_EQ(matches[1]->reason(), "repeats its image (frozen)");
  EXPECT_EQ(matches[2]->state(), panvo_msgs::msg::LandmarkMatch_Constants::UNUSABLE);
  EXPECT_EQ(matches[2]->reason(), "is upside down");
  EXPECT_EQ(corrections.size(), 1U);
}

TEST_F(CorrectorOnTopics, SaysWhereTheVehicleIsSeenFromTheLandmark) {
  publish_mounting(1.5);
  publish_landmark(2, 2);
  publish_panorama(turned(place(2), 270));
  ASSERT_EQ(corrections.size(), 1U);
  const auto& correction = *corrections[0];
  EXPECT_EQ(correction.state(), panvo_msgs::msg::PositionCorrection_Constants::FULL) << correction.reason();
  EXPECT_EQ(correction.reason(), "");
  EXPECT_EQ(correction.landmark_id(), 2U);
  EXPECT_GE(correction.inliers(), 12U);
  EXPECT_EQ(conversions::to_ns(correction.header().stamp()), kPeriod_ns);
  const auto pose = conversions::to_isometry(correction.landmark_from_base().pose());
  ASSERT_TRUE(pose);
  // a quarter turn to the left at the same position; the camera is half a metre lower than before
  EXPECT_LT((pose->linear() - vision::so3_exp(Eigen::Vector3d(0.0, 0.0, M_PI / 2.0))).norm(), 0.01);
  EXPECT_LT((pose->translation() - Eigen::Vector3d(0.0, 0.0, 0.5)).norm(), 0.1);
  const auto covariance = conversions::to_matrix(correction.landmark_from_base().covariance());
  EXPECT_GT(covariance(0, 0), 0.0);
  EXPECT_LT(covariance(0, 0), 0.1);
}

TEST_F(CorrectorOnTopics, TakesTheLandmarksMountingForItsOwnAndSaysSoOnce) {
  publish_landmark(2, 2);
  publish_panorama(place(2));
  publish_panorama(place(2));
  ASSERT_EQ(corrections.size(), 2U);
  const auto pose = conversions::to_isometry(corrections[0]->landmark_from_base().pose());
  ASSERT_TRUE(pose);
  EXPECT_LT(pose->translation().norm(), 0.1);
  int said = 0;
  for (const auto& line : harness.log()) said += line.find("extrinsics stored with the landmark") != std::string::npos;
  EXPECT_EQ(said, 1);
}

TEST_F(CorrectorOnTopics, SendsAPanoramasPoseOnce) {
  publish_landmark(2, 2);
  pass();
  ASSERT_EQ(matches.back()->state(), panvo_msgs::msg::LandmarkMatch_Constants::MATCHED);
  EXPECT_EQ(conversions::to_ns(matches.back()->header().stamp()), 2 * kPeriod_ns);
  ASSERT_GE(corrections.size(), 4U);
  for (std::size_t i = 1; i < corrections.size(); ++i) {
    EXPECT_LT(conversions::to_ns(corrections[i - 1]->header().stamp()),
              conversions::to_ns(corrections[i]->header().stamp()));
  }
}

TEST_F(CorrectorOnTopics, IsLessSureAlongTheWayOfAVehicleThatDrivesFast) {
  publish_landmark(2, 2);
  publish_odometry(200.0, 1.0, 0.0);
  publish_panorama(place(2));
  publish_odometry(200.0, 1.0, 10.0);
  publish_panorama(place(2));
  ASSERT_EQ(corrections.size(), 2U);
  // 3 ms at either stamp, at 10 m/s
  EXPECT_NEAR(
      corrections[1]->landmark_from_base().covariance()[0] - corrections[0]->landmark_from_base().covariance()[0],
      2.0 * 0.03 * 0.03, 1e-4);
}

TEST_F(CorrectorOnTopics, TellsThatGeometryRejectedALandmark) {
  auto landmark = landmark_of(place(2), describer, Eigen::Vector3d::Zero());
  landmark.id = 2;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> anywhere_m(-20.0F, 20.0F);
  for (auto& keypoint : landmark.keypoints)
    keypoint.point_in_panorama = Eigen::Vector3f{anywhere_m(random), anywhere_m(random), anywhere_m(random)};
  harness.publish(topics::kLandmarks, to_message(landmark, landmarks::landmark_settings({}, {}, 1), "map"));
  cv::Mat disturbed = place(2);
  publish_panorama(disturbed);
  ASSERT_EQ(corrections.size(), 1U);
  EXPECT_EQ(corrections[0]->state(), panvo_msgs::msg::PositionCorrection_Constants::REJECTED);
  EXPECT_EQ(corrections[0]->landmark_id(), 2U);
  EXPECT_EQ(corrections[0]->reason().rfind("landmark 2: ", 0), 0U) << corrections[0]->reason();
}

TEST_F(CorrectorOnTopics, RejectsTheMostSimilarLandmarkWhereThereIsNone) {
  publish_landmark(1, 1);
  for (unsigned seed = 80; seed < 90; ++seed) publish_panorama(place(seed));
  ASSERT_EQ(matches.size(), 10U);
  for (const auto& match : matches) EXPECT_NE(match->state(), panvo_msgs::msg::LandmarkMatch_Constants::LOCKED);
  EXPECT_FALSE(corrections.empty()) << "none was similar";
  for (const auto& correction : corrections)
    EXPECT_EQ(correction->state(), panvo_msgs::msg::PositionCorrection_Constants::REJECTED);
}

TEST_F(CorrectorOnTopics, LooksForALandmarkWhereItWasMovedTo) {
  publish_landmark(2, 2);
  publish_poses({{2, 500.0}});
  publish_odometry(200.0, 1.0);
  publish_panorama(place(2));
  EXPECT_EQ(matches.back()->candidates(), 0U);
  publish_odometry(500.0, 1.0);
  publish_panorama(place(2));
  EXPECT_EQ(matches.back()->state(), panvo_msgs::msg::LandmarkMatch_Constants::LOCKED) << matches.back()->reason();
}

TEST_F(CorrectorOnTopics, MovesALandmarkThatComesAfterItsPose) {
  publish_poses({{2, 500.0}});
  publish_landmark(2, 2);
  publish_odometry(500.0, 1.0);
  publish_panorama(place(2));
  EXPECT_EQ(matches.back()->candidates(), 1U);
}

TEST_F(CorrectorOnTopics, TakesNoLandmarkForAnotherOfTheSameId) {
  publish_landmark(2, 2);
  auto other = landmark_of(place(3), describer, Eigen::Vector3d(500.0, 0.0, 0.0));  // of a builder that was restarted
  other.id = 2;
  other.stamp_ns += 1'000'000'000;
  harness.publish(topics::kLandmarks, to_message(other, landmarks::landmark_settings({}, {}, 1), "map"));
  EXPECT_TRUE(harness.log_contains("landmark 2: its id is that of another one; skipped"));
  publish_odometry(200.0, 1.0);
  publish_panorama(place(2));
  EXPECT_EQ(matches.back()->state(), panvo_msgs::msg::LandmarkMatch_Constants::LOCKED) << matches.back()->reason();
}

TEST_F(CorrectorOnTopics, LeavesLandmarksWhereTheyAreWhenTheirPosesAreMalformed) {
  publish_landmark(2, 2);
  panvo_msgs::msg::LandmarkPoses message;
  message.ids({2});
  harness.publish(topics::kLandmarkPoses, message);
  EXPECT_TRUE(harness.log_contains("was dropped: poses differ in number from ids"));
  publish_odometry(200.0, 1.0);
  publish_panorama(place(2));
  EXPECT_EQ(matches.back()->candidates(), 1U);
}

TEST_F(CorrectorOnTopics, DoesNotTakeACorrectionsJumpForWayThatLeavesALandmark) {
  publish_odometry(0.0, 1.0, 1.0);
  publish_panorama(place(80));
  publish_landmark(2, 2);
  publish_odometry(200.0, 1.0, 1.0);  // a jump of 200 m at walking pace: a correction
  publish_panorama(place(2));
  EXPECT_EQ(matches.back()->candidates(), 0U) << "just built";
}

TEST_F(CorrectorOnTopics, LooksWhereTheVehicleWasWhenALatePanoramaWasTaken) {
  publish_landmark(2, 2);
  publish_odometry(200.0, 1.0, 20.0);
  frames += 20;
  publish_odometry(400.0, 1.0, 20.0);
  frames -= 20;
  publish_panorama(place(2));
  EXPECT_EQ(matches.back()->state(), panvo_msgs::msg::LandmarkMatch_Constants::LOCKED) << matches.back()->reason();
}

TEST_F(CorrectorOnTopics, KeepsLandmarksInMemoryWhereThereIsNoFolderForThem) {
  runtime::ComponentHarness other;
  const auto& found = other.collect(topics::kLandmarkMatch);
  other.load("panvo_position_corrector", "PositionCorrectorComponent", {{"spill_folder", "/no/such/folder"}});
  auto landmark = landmark_of(place(2), describer, Eigen::Vector3d::Zero());
  landmark.id = 2;
  other.publish(topics::kLandmarks, to_message(landmark, landmarks::landmark_settings({}, {}, 1), "map"));
  EXPECT_TRUE(other.log_contains("landmarks stay in memory"));
  auto message = conversions::make_image(kPeriod_ns, "panorama", "mono8", kColumns, kRows);
  place(2).copyTo(conversions::pixels(*message));
  other.publish(topics::kPanorama, std::shared_ptr<const sensor_msgs::msg::Image>(message));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0]->state(), panvo_msgs::msg::LandmarkMatch_Constants::LOCKED) << found[0]->reason();
}

// [Lu2015 5.2]
TEST_F(PaperPositionCorrector, CorrectsOnceAPassAtTheNearestPoint) {
  publish_landmark(2, 2);
  pass();
  ASSERT_EQ(matches.back()->state(), panvo_msgs::msg::LandmarkMatch_Constants::MATCHED);
  ASSERT_EQ(corrections.size(), 1U);
  const auto& correction = *corrections[0];
  EXPECT_NE(correction.state(), panvo_msgs::msg::PositionCorrection_Constants::REJECTED) << correction.reason();
  EXPECT_EQ(conversions::to_ns(correction.header().stamp()), 2 * kPeriod_ns);
  EXPECT_EQ(correction.landmark_id(), 2U);
  const auto pose = conversions::to_isometry(correction.landmark_from_base().pose());
  ASSERT_TRUE(pose);
  EXPECT_LT((pose->linear() - Eigen::Matrix3d::Identity()).norm(), 0.01);
}

}  // namespace
}  // namespace panvo::position_corrector
