// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/conversions/transform_buffer.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/testing.hpp"
#include "park.hpp"

namespace panvo::all_round_odometry {
namespace {

class AllRoundOdometryComponentTest : public ::testing::Test {
 protected:
  void SetUp() override { harness_.load("panvo_all_round_odometry", "AllRoundOdometryComponent"); }

  void publish_mounting(const Eigen::Vector3d& base_from_camera) {
    tf2_msgs::msg::TFMessage transforms;
    transforms.transforms({conversions::to_static_transform(
        Park::stamp_ns(0), "base_link", "panorama", Eigen::Isometry3d(Eigen::Translation3d(base_from_camera)))});
    harness_.publish(topics::kTfStatic, transforms);
  }

  void publish_stereo(double panorama, bool is_reliable) {
    const auto stamp =
        conversions::to_stamp(Park::stamp_ns(0) + std::llround(panorama * double(kInterval_ns)) - back_ns_);
    panvo_msgs::msg::OdometryQuality quality;
    quality.header().stamp(stamp);
    quality.reliable(is_reliable);
    quality.inlier_ratio(0.7);
    quality.lean_sigma_rad_per_m(5e-4);
    harness_.publish(topics::kOdometryQuality, quality);
    if (is_reliable) last_ = stereo_from_odom_ * Park::vehicle(panorama);
    nav_msgs::msg::Odometry odometry;
    odometry.header().stamp(stamp);
    odometry.header().frame_id("odom");
    odometry.child_frame_id("base_link");
    odometry.pose().pose(conversions::to_pose(last_));
    covariance_ += (is_reliable ? 1e-6 : 0.01) * vision::Matrix6d::Identity();
    odometry.pose().covariance(conversions::to_array(covariance_));
    odometry.twist().twist().linear().x(4.9);
    harness_.publish(topics::kOdometryBinocular, odometry);
  }

  void publish_points(int now) {
    const auto seen = park_.seen(now, Park::references(now));
    panvo_msgs::msg::PanoramaPoints message;
    message.header().stamp(conversions::to_stamp(seen.stamp_ns - back_ns_));
    message.header().frame_id("panorama");
    message.now_from_then(conversions::to_pose(Eigen::Isometry3d(seen.now_from_then)).orientation());
    for (const PointTracks& tracks : seen.tracks) {
      panvo_msgs::msg::PointTracks said;
      said.from_stamp(conversions::to_stamp(tracks.from_ns - back_ns_));
      for (const Sighting& sighting : tracks.sightings) {
        panvo_msgs::msg::TrackedPoint point;
        point.id(static_cast<std::uint32_t>(sighting.id));
        point.then(conversions::to_vector3(sighting.then));
        point.now(conversions::to_vector3(sighting.now));
        point.azimuth_variance_rad2(sighting.variance_rad2.x());
        point.elevation_variance_rad2(sighting.variance_rad2.y());
        said.points().push_back(point);
      }
      message.tracks().push_back(said);
    }
    harness_.publish(topics::kPanoramaPoints, message);
  }

  void drive(int from, int to, bool is_reliable) {
    for (int now = from; now <= to; ++now) {
      for (int frame = 1; frame <= 5; ++frame) publish_stereo(now - 1 + 0.2 * frame, is_reliable);
      publish_points(now);
    }
  }

  double error_m(int panorama) const {
    return (conversions::to_isometry(odometry_.back()->pose().pose())->translation() -
            Park::vehicle(panorama).translation())
        .norm();
  }

  runtime::ComponentHarness harness_;
  const std::vector<std::shared_ptr<const nav_msgs::msg::Odometry>>& odometry_ =
      harness_.collect(topics::kOdometryAllRound);
  const std::vector<std::shared_ptr<const panvo_msgs::msg::OdometryQuality>>& quality_ =
      harness_.collect(topics::kOdometryAllRoundQuality);
  Park park_{1, 1e-4};
  Eigen::Isometry3d last_ = Eigen::Isometry3d::Identity(), stereo_from_odom_ = last_;
  std::int64_t back_ns_ = 0;  // all clocks
  vision::Matrix6d covariance_ = 1e-6 * vision::Matrix6d::Identity();
};

TEST_F(AllRoundOdometryComponentTest, PassesReliableStereoOdometryOn) {
  publish_mounting(kCamera);
  drive(1, 4, true);
  ASSERT_EQ(odometry_.size(), 20U);
  ASSERT_EQ(quality_.size(), 20U);
  EXPECT_EQ(odometry_.back()->header().frame_id(), "odom");
  EXPECT_EQ(odometry_.back()->child_frame_id(), "base_link");
  EXPECT_EQ(odometry_.back()->twist().twist().linear().x(), 4.9);
  EXPECT_EQ(odometry_.back()->header().stamp(), quality_.back()->header().stamp());
  EXPECT_TRUE(quality_.back()->reliable());
  EXPECT_NEAR(quality_.back()->inlier_ratio(), 0.7, 1e-12);
  EXPECT_EQ(quality_.back()->lean_sigma_rad_per_m(), 5e-4);
}

TEST_F(AllRoundOdometryComponentTest, ContinuesByPanoramasAndSaysSo) {
  publish_mounting(kCamera);
  drive(1, 12, true);
  drive(13, 30, false);
  ASSERT_EQ(odometry_.size(), 12U * 5U + 18U);
  EXPECT_EQ(odometry_.back()->header().stamp(), conversions::to_stamp(Park::stamp_ns(30)));
  EXPECT_LT(error_m(30), 0.2);
  EXPECT_TRUE(quality_.back()->reliable());
  EXPECT_NEAR(odometry_.back()->twist().twist().linear().x(), 5.0, 0.2);
  EXPECT_TRUE(harness_.log_contains("panoramas continue the odometry"));
  drive(31, 34, true);
  EXPECT_TRUE(harness_.log_contains("the stereo camera measures the motion again"));
}

TEST_F(AllRoundOdometryComponentTest, ContinuesByPanoramasWhileTheStereoOdometryIsSilent) {
  publish_mounting(kCamera);
  drive(1, 12, true);
  publish_points(13);
  EXPECT_EQ(odometry_.back()->header().stamp(), conversions::to_stamp(Park::stamp_ns(12))) << "it may only be late";
  for (int now = 14; now <= 20; ++now) publish_points(now);
  EXPECT_EQ(odometry_.back()->header().stamp(), conversions::to_stamp(Park::stamp_ns(20)));
  EXPECT_TRUE(quality_.back()->reliable());
  EXPECT_LT(error_m(20), 0.2);
}

TEST_F(AllRoundOdometryComponentTest, UsesThePositionOfTheCameraInTfStatic) {
  publish_mounting(kCamera - Eigen::Vector3d(3.0, 0.0, 0.0));  // not where it is
  drive(1, 12, true);
  drive(13, 30, false);
  EXPECT_GT(error_m(30), 0.3);
}

TEST_F(AllRoundOdometryComponentTest, SaysUnreliableWithoutPoints) {
  for (int frame = 1; frame <= 20; ++frame) publish_stereo(0.2 * frame, frame < 10);
  ASSERT_EQ(quality_.size(), 20U);
  EXPECT_FALSE(quality_.back()->reliable());
  EXPECT_EQ(quality_.back()->reason(), "neither the stereo camera nor panoramas measure the motion");
}

TEST_F(AllRoundOdometryComponentTest, StartsAnewIfTheClockIsSetBack) {
  drive(1, 4, true);
  for (int i = 0; i < 6; ++i) publish_stereo(0.2 + 0.01 * i, true);
  EXPECT_TRUE(harness_.log_contains("was set back"));
  EXPECT_EQ(odometry_.back()->header().stamp(),
            conversions::to_stamp(Park::stamp_ns(0) + std::llround(0.25 * double(kInterval_ns))));
}

TEST_F(AllRoundOdometryComponentTest, LosesOnePoseIfTheClockIsSetBack) {
  drive(1, 4, true);
  const auto poses = odometry_.size();
  for (int i = 0; i < 2; ++i) publish_stereo(0.2 + 0.01 * i, true);  // by more than reordering
  EXPECT_EQ(odometry_.size(), poses + 1);
}

TEST_F(AllRoundOdometryComponentTest, GoesOnFromTheLastPoseIfTheClockIsSetBack) {
  publish_mounting(kCamera);
  drive(1, 12, true);
  drive(13, 30, false);
  stereo_from_odom_ = last_ * Park::vehicle(30).inverse();  // 18 m are lost
  drive(31, 36, true);
  ASSERT_LT(error_m(36), 0.3);
  const double before_m2 = odometry_.back()->pose().covariance()[0];
  back_ns_ = 600'000'000'000;
  drive(37, 38, true);
  EXPECT_TRUE(harness_.log_contains("was set back"));
  EXPECT_EQ(odometry_.back()->header().stamp(), conversions::to_stamp(Park::stamp_ns(38) - back_ns_));
  EXPECT_LT(error_m(38), 0.3);
  EXPECT_GE(odometry_.back()->pose().covariance()[0], before_m2);
  drive(39, 50, true);
  drive(51, 60, false);
  EXPECT_LT(error_m(60), 0.6) << "panoramas are used again";
  EXPECT_TRUE(quality_.back()->reliable());
}

}  // namespace
}  // namespace panvo::all_round_odometry
