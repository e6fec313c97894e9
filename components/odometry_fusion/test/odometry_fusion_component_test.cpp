// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/conversions/transform_buffer.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/testing.hpp"

namespace panvo::odometry_fusion {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::int64_t kBegin_ns = 1'700'000'000'000'000'000;

/// Drives in eights at 5 m/s; the stereo odometry is exact.
class FusionComponent : public ::testing::Test {
 protected:
  void SetUp() override { harness_.load("panvo_odometry_fusion", "OdometryFusionComponent"); }

  static double yaw_rate(double t_s) { return 0.5 * std::sin(0.5 * t_s); }

  void drive(double from_s, double to_s, bool is_reliable = true) {
    for (auto i = std::lround(from_s / 0.005); i < std::lround(to_s / 0.005); ++i) {
      const double t_s = 0.005 * static_cast<double>(i);
      if (i % 8 == 0) publish_stereo(t_s, is_reliable);
      if (has_imu_) publish_imu(t_s, i);
      if (has_wheels_ && i % 4 == 0) publish_wheels(t_s);
      vision::Vector6d twist;
      twist << 5.0, 0.0, 0.0, 0.0, 0.0, yaw_rate(t_s + 0.0025);
      truth_ = truth_ * vision::se3_exp(0.005 * twist);
    }
  }

  builtin_interfaces::msg::Time stamp(double t_s) const {
    return conversions::to_stamp(kBegin_ns + std::llround((t_s - back_s_) * 1e9));
  }

  void publish_stereo(double t_s, bool is_reliable) {
    panvo_msgs::msg::OdometryQuality quality;
    quality.header().stamp(stamp(t_s));
    quality.reliable(is_reliable);
    quality.inlier_ratio(0.7);
    quality.lean_sigma_rad_per_m(5e-4);
    harness_.publish(topics::kOdometryQuality, quality);
    covariance_ += 1e-6 * vision::Matrix6d::Identity();
    if (!is_reliable) covariance_ += 1e-3 * vision::Matrix6d::Identity();
    nav_msgs::msg::Odometry odometry;
    odometry.header().stamp(stamp(t_s));
    odometry.header().frame_id("odom");
    odometry.child_frame_id("base_link");
    odometry.pose().pose(
        conversions::to_pose(is_reliable ? stereo_from_odom_ * truth_ : Eigen::Isometry3d::Identity()));
    odometry.pose().covariance(conversions::to_array(covariance_));
    harness_.publish(topics::kOdometryBinocular, odometry);
  }

  void publish_imu(double t_s, long i) {
    sensor_msgs::msg::Imu imu;
    imu.header().stamp(stamp(t_s));
    imu.header().frame_id(imu_frame_);
    const Eigen::Vector3d rate =
        imu_from_base_ * Eigen::Vector3d(1e-4 * static_cast<double>(i % 3), 0.0, yaw_rate(t_s)) * imu_factor_;
    imu.angular_velocity().x(rate.x());
    imu.angular_velocity().y(rate.y());
    imu.angular_velocity().z(rate.z());
    harness_.publish(topics::kImu, imu);
  }

  void publish_wheels(double t_s) {
    geometry_msgs::msg::TwistWithCovarianceStamped wheels;
    wheels.header().stamp(stamp(t_s));
    wheels.header().frame_id("base_link");
    wheels.twist().twist().linear().x(5.0);
    wheels.twist().twist().angular().z(yaw_rate(t_s));
    harness_.publish(topics::kWheelTwist, wheels);
  }

  double error_m() const {
    const auto pose = conversions::to_isometry(fused_.back()->pose().pose());
    return (pose->translation() - truth_.translation()).norm();
  }

  runtime::ComponentHarness harness_;
  const std::vector<std::shared_ptr<const nav_msgs::msg::Odometry>>& fused_ = harness_.collect(topics::kOdometryFused);
  const std::vector<std::shared_ptr<const panvo_msgs::msg::OdometryQuality>>& quality_ =
      harness_.collect(topics::kOdometryFusedQuality);
  const std::vector<std::shared_ptr<const nav_msgs::msg::Odometry>>& fast_ = harness_.collect(topics::kOdometryFast);
  bool has_imu_ = true, has_wheels_ = true;
  std::string imu_frame_ = "imu_link";
  Eigen::Matrix3d imu_from_base_ = Eigen::Matrix3d::Identity();
  double imu_factor_ = 1.0;
  double back_s_ = 0.0;  // all clocks
  Eigen::Isometry3d stereo_from_odom_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d truth_ = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance_ = 1e-6 * vision::Matrix6d::Identity();
};

TEST_F(FusionComponent, PassesStereoOdometryOnWithoutOtherSensors) {
  has_imu_ = has_wheels_ = false;
  drive(0.0, 4.0);
  ASSERT_EQ(fused_.size(), 100U);
  ASSERT_EQ(quality_.size(), 100U);
  EXPECT_EQ(fused_.back()->header().frame_id(), "odom");
  EXPECT_EQ(fused_.back()->child_frame_id(), "base_link");
  EXPECT_EQ(fused_.back()->header().stamp(), stamp(3.96));
  EXPECT_EQ(quality_.back()->header().stamp(), stamp(3.96));
  EXPECT_TRUE(quality_.back()->reliable());
  EXPECT_NEAR(quality_.back()->inlier_ratio(), 0.7, 1e-12);
  EXPECT_EQ(quality_.back()->lean_sigma_rad_per_m(), 5e-4);
  EXPECT_LT(error_m(), 0.21);  // the pose is 40 ms old, at 5 m/s
}

TEST_F(FusionComponent, ContinuesByWheelsAndGyroscopeWithoutImages) {
  drive(0.0, 20.0);
  EXPECT_TRUE(harness_.log_contains("/imu/data: agreement with the cameras"));
  EXPECT_TRUE(harness_.log_contains("/wheel/twist: agreement with the cameras"));
  EXPECT_LT(quality_.back()->lean_sigma_rad_per_m(), 1e-4);  // the gyroscope sees it
  drive(20.0, 25.0, false);
  EXPECT_LT(error_m(), 0.35);  // the pose is up to 40 ms old
  EXPECT_TRUE(quality_.back()->reliable());
  EXPECT_NEAR(fused_.back()->twist().twist().linear().x(), 5.0, 0.1);
}

TEST_F(FusionComponent, NamesAFaultySensorAndItsRemedy) {
  imu_factor_ = 57.3;
  drive(0.0, 10.0);
  EXPECT_THAT(harness_.log(),
              Contains(HasSubstr("/imu/data: rates about z are in degrees/s: publish rad/s; not used")));
  EXPECT_LT(error_m(), 0.21);
}

TEST_F(FusionComponent, UsesTheMountingInTfStatic) {
  imu_from_base_ << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  Eigen::Isometry3d base_from_imu = Eigen::Isometry3d::Identity();
  base_from_imu.linear() = imu_from_base_.transpose();
  tf2_msgs::msg::TFMessage transforms;
  transforms.transforms({conversions::to_static_transform(kBegin_ns, "base_link", "imu_link", base_from_imu)});
  harness_.publish(topics::kTfStatic, transforms);
  drive(0.0, 10.0);
  EXPECT_TRUE(harness_.log_contains("/imu/data: agreement with the cameras"));
  EXPECT_FALSE(harness_.log_contains("no transform"));
}

TEST_F(FusionComponent, UsesOneOfTwoSensorsOnATopic) {
  drive(0.0, 1.0);
  imu_frame_ = "other_imu";
  drive(1.0, 2.0);
  EXPECT_THAT(harness_.log(), Contains(HasSubstr("comes from several sensors, 'imu_link' and 'other_imu'")));
}

TEST_F(FusionComponent, CarriesTheEnhancedPoseOnToEachSampleOfTheGyroscope) {
  drive(0.0, 20.0);
  EXPECT_TRUE(fast_.empty()) << "no pose in the map yet";
  // The localizer puts the odometry's origin at 100 m, turned by 90 degrees.
  Eigen::Isometry3d map_from_odom(Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitZ()));
  map_from_odom.translation().x() = 100.0;
  auto enhanced = *fused_.back();
  enhanced.header().frame_id("map");
  enhanced.pose().pose(conversions::to_pose(map_from_odom * *conversions::to_isometry(fused_.back()->pose().pose())));
  harness_.publish(topics::kOdometryEnhanced, enhanced);
  drive(20.0, 20.5);
  ASSERT_GE(fast_.size(), 90U) << "of 100; a new pose of the stereo odometry waits for the next sample";
  EXPECT_EQ(fast_.back()->header().frame_id(), "map");
  EXPECT_EQ(fast_.back()->child_frame_id(), "base_link");
  EXPECT_LT(std::abs(conversions::stamp_ns(*fast_.back()) - conversions::to_ns(stamp(20.495))), 2'000'000)
      << "of the cameras' clock";
  Eigen::Isometry3d before = truth_;
  before.translation() -= 0.005 * 5.0 * truth_.linear().col(0);
  const auto pose = conversions::to_isometry(fast_.back()->pose().pose());
  EXPECT_LT(((map_from_odom * before).translation() - pose->translation()).norm(), 0.02);
  EXPECT_NEAR(fast_.back()->twist().twist().angular().z(), yaw_rate(20.495), 0.02);
}

TEST_F(FusionComponent, BeginsAnewWhenTheClockIsSetBack) {
  drive(100.0, 102.0);
  const auto before = fused_.size();
  drive(0.0, 2.0);
  EXPECT_THAT(harness_.log(), Contains(HasSubstr("the clock of /odometry/binocular was set back")));
  EXPECT_GT(fused_.size(), before + 40);
}

TEST_F(FusionComponent, GoesOnFromTheLastPoseWhenTheClockIsSetBack) {
  drive(0.0, 20.0);
  drive(20.0, 25.0, false);
  stereo_from_odom_ = truth_.inverse();  // its path goes on from the start
  drive(25.0, 27.0);
  ASSERT_LT(error_m(), 0.4);
  double t_s = 27.0;
  for (const double by_s : {10.0, 600.0}) {
    const std::size_t before = fused_.size();
    back_s_ += by_s;
    drive(t_s, t_s + 2.0);
    t_s += 2.0;
    ASSERT_GT(fused_.size(), before + 40);
    EXPECT_LT(error_m(), 0.4) << "the pose is 40 ms old";
    for (std::size_t i = before; i < fused_.size(); ++i) {
      const auto from = conversions::to_isometry(fused_[i - 1]->pose().pose());
      const auto to = conversions::to_isometry(fused_[i]->pose().pose());
      EXPECT_LT((to->translation() - from->translation()).norm(), i == before ? 1.1 : 0.25) << "4 poses are refused";
      EXPECT_GE(fused_[i]->pose().covariance()[0], fused_[i - 1]->pose().covariance()[0]);
    }
  }
}

}  // namespace
}  // namespace panvo::odometry_fusion
