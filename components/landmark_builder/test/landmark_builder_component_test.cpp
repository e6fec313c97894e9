// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "painted_town.hpp"
#include "panvo/conversions/image.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/conversions/transform_buffer.hpp"
#include "panvo/interfaces/time_topics.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/testing.hpp"

namespace panvo::landmark_builder {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

class LandmarkBuilderComponent : public ::testing::Test {
 protected:
  /// By default, no landmark at the start of the drive.
  void load(std::map<std::string, std::string> parameters = {}) {
    parameters.try_emplace("rule.first_m", "1000");
    harness_.load("panvo_landmark_builder", "LandmarkBuilderComponent", parameters);
  }

  void publish_mounting(const Eigen::Isometry3d& base_from_panorama = PaintedTown::base_from_panorama()) {
    tf2_msgs::msg::TFMessage message;
    message.transforms({conversions::to_static_transform(1, "base_link", "panorama_optical", base_from_panorama)});
    harness_.publish(topics::kTfStatic, message);
  }

  void publish_odometry(std::int64_t stamp_ns, const Eigen::Isometry3d& pose) {
    nav_msgs::msg::Odometry odometry;
    odometry.header().stamp(conversions::to_stamp(stamp_ns));
    odometry.header().frame_id("odom");
    odometry.child_frame_id("base_link");
    odometry.pose().pose(conversions::to_pose(pose));
    harness_.publish(topics::kOdometryBinocular, odometry);
  }

  void publish_panorama(std::int64_t stamp_ns, const cv::Mat& pixels) {
    auto message = conversions::make_image(stamp_ns, "panorama_optical", "bgr8", pixels.cols, pixels.rows);
    pixels.copyTo(conversions::pixels(*message));
    harness_.publish(topics::kPanorama, std::shared_ptr<const sensor_msgs::msg::Image>(message));
  }

  void publish_time_reference(std::int64_t panorama_ahead_ns = 300'000'000) {
    sensor_msgs::msg::TimeReference message;
    message.header().stamp(conversions::to_stamp(100'000'000'000));
    message.time_ref(conversions::to_stamp(100'000'000'000 + panorama_ahead_ns));
    harness_.publish(topics::kPanoramaTimeReference, message);
  }

  /// Drives through the crossing at the origin; odometry 20 ms before and after each panorama. With its clock ahead,
  /// the panoramic camera stamps 0.3 s more, which becomes known at `known_m`.
  void drive(std::optional<double> known_m = std::nullopt, double from_m = -28.0, double to_m = 24.0) {
    for (double x = from_m; x < to_m; x += 1.0) {
      const auto stamp_ns = static_cast<std::int64_t>(1e9 * (100.0 + ahead_s_ + 0.2 * x));
      publish_odometry(stamp_ns - 20'000'000, PaintedTown::at(x - 0.1, -1.5, 0.0));
      if (x == known_m) publish_time_reference();
      publish_panorama(stamp_ns + (known_m ? 300'000'000 : 0), town_.panorama(PaintedTown::at(x, -1.5, 0.0)));
      publish_odometry(stamp_ns + 20'000'000, PaintedTown::at(x + 0.1, -1.5, 0.0));
    }
  }

  /// Says that the vehicle's odometry began so far away, to the left.
  void move_map(double by_m) {
    const auto begin = PaintedTown::at(-40.0, -1.5, 0.0);
    publish_odometry(80'000'000'000, begin);
    nav_msgs::msg::Odometry enhanced;
    enhanced.header().stamp(conversions::to_stamp(80'000'000'000));
    enhanced.pose().pose(conversions::to_pose(Eigen::Translation3d(0.0, by_m, 0.0) * begin));
    harness_.publish(topics::kOdometryEnhanced, enhanced);
  }

  const PaintedTown town_ = PaintedTown::star({0.0, 0.5 * M_PI, M_PI, 1.5 * M_PI});
  double ahead_s_ = 0.0;  // all clocks
  runtime::ComponentHarness harness_;
  const std::vector<std::shared_ptr<const panvo_msgs::msg::PanoramicLandmark>>& landmarks_ =
      harness_.collect(topics::kLandmarks);
};

TEST_F(LandmarkBuilderComponent, PublishesALandmarkOfThePanoramaNearestToTheCrossing) {
  load();
  publish_mounting();
  drive();
  ASSERT_THAT(landmarks_, SizeIs(1));
  const auto& landmark = *landmarks_[0];
  EXPECT_EQ(landmark.id(), 1U);
  EXPECT_TRUE(landmark.is_junction());
  EXPECT_EQ(landmark.header().frame_id(), "map");
  const double x = landmark.pose().pose().position().x();
  EXPECT_LT(std::abs(x), 4.0);
  EXPECT_NEAR(static_cast<double>(conversions::stamp_ns(landmark)) * 1e-9, 100.0 + 0.2 * x, 1e-3);
}

TEST_F(LandmarkBuilderComponent, LevelsThePanoramasOfACameraThatIsMountedAtATilt) {
  load({{"rule.first_m", "0"}});
  Eigen::Isometry3d tilted = PaintedTown::base_from_panorama();
  tilted.linear() = vision::so3_exp({0.1, 0.2, 0.0}) * tilted.linear();
  publish_mounting(tilted);
  drive();
  ASSERT_FALSE(landmarks_.empty());
  const auto camera = conversions::to_isometry(landmarks_[0]->panorama_pose());
  ASSERT_TRUE(camera);
  EXPECT_NEAR(camera->linear()(2, 1), -1.0, 1e-9) << "its y axis points down";
  EXPECT_TRUE(camera->translation().isApprox(tilted.translation()));
}

TEST_F(LandmarkBuilderComponent, TakesNoKeypointsFromTheVehicle) {
  load();
  publish_mounting();
  const auto mask = conversions::make_image(1, "", "mono8", 108, 54);
  conversions::pixels(*mask).setTo(255);
  conversions::pixels(*mask).colRange(54, 108).setTo(0);  // all to the right of the picture's middle
  harness_.publish(topics::kVehicleMask, std::shared_ptr<const sensor_msgs::msg::Image>(mask));
  drive();
  ASSERT_THAT(landmarks_, SizeIs(1));
  EXPECT_FALSE(landmarks_[0]->keypoints().empty());
  for (const auto& keypoint : landmarks_[0]->keypoints()) EXPECT_LT(keypoint.bearing()[0], 0.0F);
}

TEST_F(LandmarkBuilderComponent, TakesThePoseOfTheTimeAtWhichThePanoramaWasTaken) {
  load();
  publish_mounting();
  drive(-28.0);
  ASSERT_THAT(landmarks_, SizeIs(1));
  const double x = landmarks_[0]->pose().pose().position().x();
  EXPECT_NEAR(static_cast<double>(conversions::stamp_ns(*landmarks_[0])) * 1e-9, 100.3 + 0.2 * x, 1e-3);
}

TEST_F(LandmarkBuilderComponent, ReplacesThePosesOfEarlierPanoramasWhenTheClockIsFound) {
  load();
  publish_mounting();
  drive(4.0);  // the crossing is being passed
  ASSERT_THAT(landmarks_, SizeIs(1));
  const double x = landmarks_[0]->pose().pose().position().x();
  EXPECT_LT(x, 4.0);
  EXPECT_NEAR(static_cast<double>(conversions::stamp_ns(*landmarks_[0])) * 1e-9, 100.3 + 0.2 * x, 1e-3);
}

TEST_F(LandmarkBuilderComponent, WaitsUntilTheClockIsFound) {
  load({{"rule.wait_for_clock_s", "60"}});
  publish_mounting();
  drive(28.0, -28.0, 30.0);
  ASSERT_THAT(landmarks_, SizeIs(1));
  const double x = landmarks_[0]->pose().pose().position().x();
  EXPECT_NEAR(static_cast<double>(conversions::stamp_ns(*landmarks_[0])) * 1e-9, 100.3 + 0.2 * x, 1e-3);
}

TEST_F(LandmarkBuilderComponent, PublishesAtTheEndWhatWaitsForTheClock) {
  load({{"rule.wait_for_clock_s", "60"}});
  publish_mounting();
  drive();
  EXPECT_THAT(landmarks_, IsEmpty());
  EXPECT_THAT(harness_.container().run(), IsEmpty());
  ASSERT_THAT(landmarks_, SizeIs(1));
  EXPECT_TRUE(landmarks_[0]->is_junction());
}

/// The stereo camera's clock alone: by its former offset, the panoramas are 1.5 m off.
TEST_F(LandmarkBuilderComponent, WaitsForTheClockAgainAfterItWasSetBack) {
  load({{"rule.wait_for_clock_s", "60"}});
  publish_mounting();
  publish_time_reference(0);
  ahead_s_ = 600.0;
  drive(std::nullopt, -31.0, -28.0);
  ahead_s_ = 0.0;
  drive(28.0, -28.0, 30.0);
  ASSERT_THAT(landmarks_, SizeIs(1));
  const double x = landmarks_[0]->pose().pose().position().x();
  EXPECT_NEAR(static_cast<double>(conversions::stamp_ns(*landmarks_[0])) * 1e-9, 100.3 + 0.2 * x, 1e-3);
}

TEST_F(LandmarkBuilderComponent, BuildsOnIfTheClockIsSetBack) {
  load({{"rule.first_m", "4"}});
  publish_mounting();
  ahead_s_ = 600.0;
  drive(std::nullopt, -31.0, -28.0);
  publish_panorama(700'000'000'000, town_.panorama(PaintedTown::at(-28.0, -1.5, 0.0)));  // its odometry does not come
  EXPECT_THAT(landmarks_, IsEmpty());
  ahead_s_ = 0.0;
  drive();
  EXPECT_FALSE(harness_.log_contains("no landmarks are built")) << "the others need not wait for that odometry";
  ASSERT_FALSE(landmarks_.empty());
  for (const auto& landmark : landmarks_) {
    const double x = landmark->pose().pose().position().x();
    EXPECT_NEAR(static_cast<double>(conversions::stamp_ns(*landmark)) * 1e-9, 100.0 + 0.2 * x, 1e-3);
  }
  EXPECT_TRUE(landmarks_.back()->is_junction());
}

/// When the crossing is passed, it is as late as it was 20 m before by the clock of then.
TEST_F(LandmarkBuilderComponent, TakesNoPanoramaOfTheSameStampFromBeforeTheClockWasSetBack) {
  load();
  publish_mounting();
  ahead_s_ = 4.0;
  drive(std::nullopt, -28.0, -16.0);
  ahead_s_ = 0.0;
  drive(std::nullopt, -16.0);
  ASSERT_THAT(landmarks_, SizeIs(1));
  EXPECT_TRUE(landmarks_[0]->is_junction());
  EXPECT_LT(std::abs(landmarks_[0]->pose().pose().position().x()), 4.0);
}

TEST_F(LandmarkBuilderComponent, SaysThatThereIsNoOdometry) {
  load();
  publish_mounting();
  const cv::Mat panorama = town_.panorama(PaintedTown::at(0.0, 0.0, 0.0), 200);
  for (int i = 1; i < 20; ++i) publish_panorama(i * 200'000'000LL, panorama);
  EXPECT_THAT(landmarks_, IsEmpty());
  EXPECT_TRUE(harness_.log_contains("no landmarks are built"));
  EXPECT_THAT(harness_.log(), SizeIs(1));
}

TEST_F(LandmarkBuilderComponent, SaysThatTheMountingIsMissing) {
  load();
  publish_panorama(1'000'000'000, town_.panorama(PaintedTown::at(0.0, 0.0, 0.0), 400));
  publish_odometry(1'000'000'000, PaintedTown::at(0.0, 0.0, 0.0));
  EXPECT_TRUE(harness_.log_contains("/tf_static"));
}

TEST_F(LandmarkBuilderComponent, SaysWhatIsWrongWithAPanoramaAndGoesOn) {
  load();
  publish_mounting();
  const auto publish = [&](std::int64_t stamp_ns, const cv::Mat& pixels) {
    publish_panorama(stamp_ns, pixels);
    publish_odometry(stamp_ns, PaintedTown::at(static_cast<double>(stamp_ns) * 1e-9, 0.0, 0.0));
  };
  publish(1'000'000'000, cv::Mat(540, 1080, CV_8UC3, cv::Scalar(0, 0, 0)));
  EXPECT_TRUE(harness_.log_contains("black"));
  publish(2'000'000'000, cv::Mat(480, 640, CV_8UC3, cv::Scalar(90, 100, 110)));
  EXPECT_TRUE(harness_.log_contains("twice as wide"));
  publish(3'000'000'000, town_.panorama(PaintedTown::at(3.0, 0.0, 0.0)));
  publish(4'000'000'000, town_.panorama(PaintedTown::at(4.0, 0.0, 0.0), 720));
  EXPECT_TRUE(harness_.log_contains("changed its size"));
  EXPECT_THAT(landmarks_, IsEmpty());
}

TEST_F(LandmarkBuilderComponent, MakesNoneOfAPanoramaThatIsTheLastAgainOrUpsideDown) {
  load();
  publish_mounting();
  const auto publish = [&](std::int64_t stamp_ns, const cv::Mat& pixels) {
    publish_panorama(stamp_ns, pixels);
    publish_odometry(stamp_ns, PaintedTown::at(static_cast<double>(stamp_ns) * 1e-9, 0.0, 0.0));
  };
  const cv::Mat panorama = town_.panorama(PaintedTown::at(3.0, 0.0, 0.0));
  cv::Mat turned_over;
  cv::flip(panorama, turned_over, -1);
  publish(3'000'000'000, panorama);
  EXPECT_THAT(harness_.log(), IsEmpty());
  publish(4'000'000'000, panorama);
  EXPECT_TRUE(harness_.log_contains("repeats its image (frozen)"));
  publish(5'000'000'000, turned_over);
  EXPECT_TRUE(harness_.log_contains("is upside down"));
}

TEST_F(LandmarkBuilderComponent, MakesNoneBesideALandmarkOfAnEarlierJourney) {
  load();
  publish_mounting();
  panvo_msgs::msg::PanoramicLandmark earlier;
  earlier.id(12);
  earlier.pose().pose().position().x(3.0);
  harness_.publish(topics::kLandmarks, earlier);
  drive();
  EXPECT_THAT(landmarks_, SizeIs(1));  // only the published one
}

TEST_F(LandmarkBuilderComponent, PlacesLandmarksWhereTheLocalizerSaysThatTheVehicleIs) {
  load();
  publish_mounting();
  // the map is offset by 100 m and a quarter turn from the odometry frame
  Eigen::Isometry3d map_from_odom = Eigen::Isometry3d::Identity();
  map_from_odom.translation() = Eigen::Vector3d(100.0, 50.0, 0.0);
  map_from_odom.linear() = Eigen::AngleAxisd(0.5 * M_PI, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const auto begin = PaintedTown::at(-40.0, -1.5, 0.0);
  publish_odometry(80'000'000'000, begin);
  nav_msgs::msg::Odometry enhanced;
  enhanced.header().stamp(conversions::to_stamp(80'000'000'000));
  enhanced.pose().pose(conversions::to_pose(map_from_odom * begin));
  harness_.publish(topics::kOdometryEnhanced, enhanced);
  drive();
  ASSERT_THAT(landmarks_, SizeIs(1));
  const auto& position = landmarks_[0]->pose().pose().position();
  EXPECT_NEAR(position.x(), 100.0 + 1.5, 0.5);
  EXPECT_NEAR(position.y(), 50.0, 4.0);
}

TEST_F(LandmarkBuilderComponent, TakesNoticeOfLandmarksThatWereMoved) {
  load();
  publish_mounting();
  panvo_msgs::msg::PanoramicLandmark first, second;
  first.id(12);
  first.histogram({1.0F});
  first.pose().pose().position().x(500.0);
  second = first;
  second.id(13);
  panvo_msgs::msg::LandmarkPoses moved;  // puts the second at the crossing
  moved.ids({12, 13});
  moved.poses().resize(2);
  moved.poses()[0].pose().position().x(400.0);
  moved.poses()[1].pose().position().x(3.0);
  harness_.publish(topics::kLandmarks, first);
  harness_.publish(topics::kLandmarkPoses, moved);
  harness_.publish(topics::kLandmarks, second);  // older than its pose, although it comes later
  drive();
  EXPECT_THAT(landmarks_, SizeIs(2));  // only the published ones
}

TEST_F(LandmarkBuilderComponent, NumbersOnAfterARestart) {
  load();
  publish_mounting();
  drive();
  ASSERT_THAT(landmarks_, SizeIs(1));
  ASSERT_TRUE(harness_.container().unload("landmark_builder"));
  load();  // hears of the landmark that its predecessor built, as the topic is latched
  move_map(100.0);
  drive();
  ASSERT_THAT(landmarks_, SizeIs(2));
  EXPECT_EQ(landmarks_[1]->id(), 2U);
}

TEST_F(LandmarkBuilderComponent, NumbersOnAfterARestartOfItsProcess) {
  panvo_msgs::msg::LandmarkPoses poses;  // the localizer's, which has gone on
  poses.ids({1, 2, 7});
  poses.poses().resize(3);
  harness_.publish(topics::kLandmarkPoses, poses);
  load();
  publish_mounting();
  move_map(100.0);
  drive();
  ASSERT_THAT(landmarks_, SizeIs(1));
  EXPECT_EQ(landmarks_[0]->id(), 8U);
}

/// Otherwise it would make none at the crossing.
TEST_F(LandmarkBuilderComponent, TakesNoLandmarkForAnotherOfTheSameId) {
  load();
  publish_mounting();
  panvo_msgs::msg::PanoramicLandmark first, other;
  first.id(12);
  first.histogram({1.0F});
  first.pose().pose().position().x(500.0);
  other = first;
  other.header().stamp(conversions::to_stamp(5));
  other.pose().pose().position().x(3.0);
  harness_.publish(topics::kLandmarks, first);
  harness_.publish(topics::kLandmarks, other);
  drive();
  EXPECT_THAT(landmarks_, SizeIs(3));  // with the two published ones
}

TEST_F(LandmarkBuilderComponent, RefusesAParameterOutOfItsRange) {
  EXPECT_ANY_THROW(load({{"junction.criterion", "hough"}}));
  EXPECT_ANY_THROW(load({{"junction.arms.directions", "3"}}));
}

}  // namespace
}  // namespace panvo::landmark_builder
