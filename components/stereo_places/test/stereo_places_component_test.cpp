// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>

#include "made_up_keypoints.hpp"
#include "panvo/conversions/camera_info.hpp"
#include "panvo/conversions/image.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/conversions/transform_buffer.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/landmarks/landmark_messages.hpp"
#include "panvo/runtime/testing.hpp"
#include "panvo/stereo_places/stereo_places.hpp"
#include "street.hpp"

namespace panvo::stereo_places {
namespace {

constexpr std::int64_t kPeriod_ns = 500'000'000;

Eigen::Isometry3d base_from_left() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  pose.translation() << 1.5, 0.1, 1.3;
  return pose;
}

class StereoPlacesComponent : public testing::Test {
 protected:
  void load() { harness_->load("panvo_stereo_places", "StereoPlacesComponent", {{"spill_folder", ""}}); }

  void publish_cameras(const vision::RectifiedStereo& stereo = Street::stereo()) {
    vision::StereoCalibration calibration;
    calibration.left.pinhole = calibration.right.pinhole = stereo.camera;
    calibration.right_from_left.translation().x() = -stereo.baseline_m;
    harness_->publish(topics::kStereoLeftCameraInfo,
                      conversions::to_camera_info(conversions::left_camera(calibration, stereo), 1, "left"));
    harness_->publish(topics::kStereoRightCameraInfo,
                      conversions::to_camera_info(conversions::right_camera(calibration, stereo), 1, "right"));
    tf2_msgs::msg::TFMessage message;
    message.transforms().push_back(conversions::to_static_transform(0, "base_link", "left", base_from_left()));
    harness_->publish(topics::kTfStatic, message);
  }

  void publish_image(const interfaces::Topic<sensor_msgs::msg::Image>& topic, const std::string& frame,
                     const cv::Mat& pixels) {
    auto message = conversions::make_image(stamp_ns, frame, "mono8", pixels.cols, pixels.rows);
    pixels.copyTo(conversions::pixels(*message));
    harness_->publish(topic, std::shared_ptr<const sensor_msgs::msg::Image>(message));
  }

  void publish_images(double z_m) {
    publish_image(topics::kStereoLeftImageRect, "left", street.left(moved(z_m)));
    publish_image(topics::kStereoRightImageRect, "right", street.right(moved(z_m)));
  }

  void publish_odometry(double z_m) {
    nav_msgs::msg::Odometry odometry;
    odometry.header().stamp(conversions::to_stamp(stamp_ns));
    odometry.pose().pose(conversions::to_pose(drift * base_from_left() * moved(z_m) * base_from_left().inverse()));
    odometry.pose().covariance(conversions::to_array(vision::Matrix6d(0.04 * vision::Matrix6d::Identity())));
    harness_->publish(topics::kOdometryBinocular, odometry);
  }

  void drive(double from_m, double to_m) {
    for (double z_m = from_m; z_m <= to_m; z_m += 1.0) {
      stamp_ns += kPeriod_ns;
      publish_images(z_m);
      publish_odometry(z_m);
    }
  }

  /// Away and back, so that what was just built is searched again.
  void drive_around() {
    for (const double x_m : {15.0, 30.0, 15.0}) {
      stamp_ns += kPeriod_ns;
      publish_odometry(x_m);
    }
  }

  std::unique_ptr<runtime::ComponentHarness> harness_ = std::make_unique<runtime::ComponentHarness>();
  const std::vector<std::shared_ptr<const panvo_msgs::msg::PanoramicLandmark>>& landmarks =
      harness_->collect(topics::kLandmarks);
  const std::vector<std::shared_ptr<const panvo_msgs::msg::LandmarkMatch>>& matches =
      harness_->collect(topics::kLandmarkMatch);
  const std::vector<std::shared_ptr<const panvo_msgs::msg::PositionCorrection>>& corrections =
      harness_->collect(topics::kCorrection);
  Street street;
  Eigen::Isometry3d drift = Eigen::Isometry3d::Identity();
  std::int64_t stamp_ns = 0;
};

TEST_F(StereoPlacesComponent, BuildsLandmarksAndCorrectsAtTheNextPass) {
  load();
  publish_cameras();
  drive(0.0, 9.0);
  ASSERT_GE(landmarks.size(), 2U);
  EXPECT_EQ(landmarks[0]->header().frame_id(), "map");
  EXPECT_NE(landmarks[0]->settings().find("camera=stereo"), std::string::npos);
  EXPECT_TRUE(landmarks::to_landmark(*landmarks[0], view_settings({})));
  EXPECT_TRUE(corrections.empty());
  drive_around();
  drift.translation().y() = 1.0;
  drive(0.0, 9.0);
  ASSERT_FALSE(corrections.empty());
  const auto& last = *corrections.back();
  EXPECT_EQ(last.state(), panvo_msgs::msg::PositionCorrection_Constants::FULL);
  const auto built = conversions::to_isometry(landmarks.at(last.landmark_id() - 1)->pose().pose());
  const auto relative = conversions::to_isometry(last.landmark_from_base().pose());
  ASSERT_TRUE(built && relative);
  EXPECT_NEAR((*built * *relative).translation().y(), 0.0, 0.1);  // in the map of the first pass, not 1 m aside
  bool is_passed = false;
  for (const auto& match : matches) is_passed |= match->state() == panvo_msgs::msg::LandmarkMatch_Constants::MATCHED;
  EXPECT_TRUE(is_passed);
}

TEST_F(StereoPlacesComponent, WaitsForTheOdometryOfAnImage) {
  load();
  publish_cameras();
  stamp_ns = kPeriod_ns;
  publish_images(0.0);
  EXPECT_TRUE(matches.empty());
  publish_odometry(0.0);
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_EQ(conversions::stamp_ns(*matches[0]), kPeriod_ns);
  EXPECT_EQ(matches[0]->header().frame_id(), "left");
}

TEST_F(StereoPlacesComponent, GoesOnIfTheClockIsSetBack) {
  load();
  publish_cameras();
  stamp_ns = 1000'000'000'000;
  drive(0.0, 4.0);
  const auto built = landmarks.size();
  stamp_ns += kPeriod_ns;
  publish_images(4.5);  // its odometry does not come
  stamp_ns -= 600'000'000'000;
  const auto before = matches.size();
  drive(5.0, 20.0);
  EXPECT_EQ(matches.size(), before + 11U) << "as soon as that is certain";
  EXPECT_EQ(conversions::stamp_ns(*matches.back()), stamp_ns);
  EXPECT_GT(landmarks.size(), built);
}

TEST_F(StereoPlacesComponent, PausesWhileTheCalibrationIsAnother) {
  load();
  publish_cameras();
  drive(0.0, 2.0);
  vision::RectifiedStereo other = Street::stereo();
  other.baseline_m *= 1.5;
  publish_cameras(other);
  drive(3.0, 6.0);  // four pairs: it is another one from the fifth on
  const auto before = matches.size();
  ASSERT_GT(before, 0U);
  drive(7.0, 9.0);
  EXPECT_EQ(matches.size(), before) << "its places would be wrong";
  EXPECT_TRUE(harness_->log_contains("changed while running: no places; restart panvo"));
  publish_cameras();
  drive(10.0, 16.0);
  EXPECT_GT(matches.size(), before);
}

TEST_F(StereoPlacesComponent, GoesOnIfTwoPublishersOfCalibrationsDisagree) {
  load();
  vision::RectifiedStereo other = Street::stereo();
  other.baseline_m *= 1.5;
  publish_cameras();
  drive(0.0, 0.0);
  for (int z_m = 1; z_m <= 7; ++z_m) {
    publish_cameras(other);
    if (z_m % 2 == 0) publish_cameras();
    drive(z_m, z_m);
  }
  EXPECT_FALSE(harness_->log_contains("changed while running"));
  EXPECT_EQ(matches.size(), 8U);
}

TEST_F(StereoPlacesComponent, DropsOdometryThatIsLate) {
  load();
  publish_cameras();
  stamp_ns = 1000'000'000'000;
  for (int i = 0; i < 8; ++i) {
    drive(i, i);
    stamp_ns -= 600'000'000'000;
    publish_odometry(70.0);
    stamp_ns += 600'000'000'000;
  }
  EXPECT_EQ(matches.size(), 8U);
}

TEST_F(StereoPlacesComponent, SaysThatThereIsNoOdometry) {
  load();
  publish_cameras();
  for (int i = 0; i < 12; ++i) {
    stamp_ns += kPeriod_ns;
    publish_images(0.0);
  }
  EXPECT_TRUE(harness_->log_contains("nothing on /odometry/binocular for their stamps"));
}

TEST_F(StereoPlacesComponent, RecognisesLandmarksOfAnEarlierSession) {
  load();
  publish_cameras();
  drive(0.0, 9.0);
  const auto stored = landmarks;
  harness_ = std::make_unique<runtime::ComponentHarness>();  // the next day
  const auto& found = harness_->collect(topics::kCorrection);
  load();
  for (const auto& landmark : stored) harness_->publish(topics::kLandmarks, landmark);
  publish_cameras();
  stamp_ns += 3600'000'000'000;
  drive(0.0, 9.0);
  EXPECT_FALSE(found.empty());
}

TEST_F(StereoPlacesComponent, RepeatsItselfBitForBit) {
  const auto twice = [this] {
    load();
    publish_cameras();
    stamp_ns = 0;
    drive(0.0, 6.0);
    drive_around();
    drive(0.0, 6.0);
  };
  twice();
  const auto built = landmarks;
  const auto corrected = corrections;
  ASSERT_FALSE(corrected.empty());
  harness_ = std::make_unique<runtime::ComponentHarness>();
  const auto& built_again = harness_->collect(topics::kLandmarks);
  const auto& corrected_again = harness_->collect(topics::kCorrection);
  twice();
  ASSERT_EQ(built.size(), built_again.size());
  for (std::size_t i = 0; i < built.size(); ++i) EXPECT_TRUE(*built[i] == *built_again[i]);
  ASSERT_EQ(corrected.size(), corrected_again.size());
  for (std::size_t i = 0; i < corrected.size(); ++i) EXPECT_TRUE(*corrected[i] == *corrected_again[i]);
}

TEST_F(StereoPlacesComponent, LeavesOutLandmarksOfPanoramas) {
  load();
  landmarks::PanoramicLandmark other;
  other.id = 77;
  other.description.histogram.assign(64, 1.0F / 64);
  const auto settings = landmarks::description_settings(landmarks::DescriptionParameters{}, 1);
  harness_->publish(topics::kLandmarks, landmarks::to_message(other, settings, "map"));
  EXPECT_TRUE(harness_->log_contains("landmark 77 was described with other settings"));
  publish_cameras();
  drive(0.0, 0.0);
  EXPECT_EQ(landmarks.back()->id(), 78U) << "to the localizer, a place of the same id would be landmark 77";
  EXPECT_EQ(matches.back()->candidates(), 0U);
}

TEST_F(StereoPlacesComponent, NumbersPlacesAboveThoseOfWhichOnlyThePosesArrived) {
  load();
  panvo_msgs::msg::LandmarkPoses poses;
  poses.header().frame_id("map");
  poses.ids({41});
  poses.poses().resize(1);
  poses.poses()[0].pose().orientation().w(1.0);
  harness_->publish(topics::kLandmarkPoses, poses);
  publish_cameras();
  drive(0.0, 0.0);
  ASSERT_EQ(landmarks.size(), 1U);
  EXPECT_EQ(landmarks[0]->id(), 42U);
}

TEST_F(StereoPlacesComponent, TakesNoLandmarkForAnotherOfTheSameId) {
  load();
  publish_cameras();
  drive(0.0, 0.0);
  auto other = *landmarks.at(0);  // of a process that was restarted and counts from 1 again
  other.header().stamp(conversions::to_stamp(stamp_ns + 1));
  other.pose().pose().position().x(500.0);
  harness_->publish(topics::kLandmarks, other);
  EXPECT_TRUE(harness_->log_contains("landmark 1: its id is that of another one; skipped"));
  drive_around();
  drive(0.0, 0.0);
  EXPECT_EQ(matches.back()->candidates(), 1U);  // it stands where it stood
}

TEST_F(StereoPlacesComponent, FollowsMovedLandmarks) {
  load();
  publish_cameras();
  drive(0.0, 0.0);
  panvo_msgs::msg::LandmarkPoses poses;
  auto pose = landmarks.at(0)->pose();
  pose.pose().position().x(500.0);
  poses.ids({1});
  poses.poses({pose});
  harness_->publish(topics::kLandmarkPoses, poses);
  drive_around();
  drive(0.0, 0.0);
  EXPECT_EQ(matches.back()->candidates(), 0U);  // it stands elsewhere now
}

}  // namespace
}  // namespace panvo::stereo_places
