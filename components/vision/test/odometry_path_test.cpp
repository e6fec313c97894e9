// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/odometry_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace panvo::vision {
namespace {

/// Straight ahead at 5 m/s, 25 Hz; the covariance grows.
class OdometryPathTest : public ::testing::Test {
 protected:
  OnPath step(double gap_s = 0.0) {
    const double time_s = 0.04 + gap_s;
    stamp_ns_ += std::llround(1e9 * time_s);
    pose_.translation().x() += 5.0 * time_s;
    covariance_ += 1e-4 * Matrix6d::Identity();
    return path_.add(stamp_ns_, pose_, covariance_, true);
  }

  void drive(int steps) {
    for (int i = 0; i < steps; ++i) ASSERT_EQ(step(), OnPath::kGoesOn) << i;
  }

  void restart() {
    pose_.setIdentity();
    covariance_.setZero();
  }

  OdometryPath path_{70.0};
  std::int64_t stamp_ns_ = 0;
  Eigen::Isometry3d pose_ = Eigen::Isometry3d::Identity();
  Matrix6d covariance_ = Matrix6d::Zero();
};

TEST_F(OdometryPathTest, FollowsFromTheSecondPoseOn) {
  drive(1);
  EXPECT_FALSE(path_.follows());
  EXPECT_TRUE(path_.velocity().isZero());
  drive(10);
  EXPECT_TRUE(path_.follows());
  EXPECT_NEAR(path_.velocity().x(), 5.0, 1e-9);
}

TEST_F(OdometryPathTest, TellsARestartFromTheFifthPoseOnAndItsMotionFromTheSecondOn) {
  drive(100);
  restart();
  EXPECT_EQ(step(2.0), OnPath::kElsewhere);
  EXPECT_FALSE(path_.follows());
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(step(), OnPath::kElsewhere);
    EXPECT_TRUE(path_.follows());
  }
  EXPECT_EQ(step(), OnPath::kRestarted);
  EXPECT_TRUE(path_.follows());
  EXPECT_NEAR(path_.motion_to_restart().translation().x(), 5.0 * (2.0 + 5 * 0.04), 1e-6);
  drive(10);
  EXPECT_TRUE(path_.follows());
}

TEST_F(OdometryPathTest, DoesNotFollowAWrongPose) {
  drive(100);
  Eigen::Isometry3d wrong = pose_;
  wrong.translation().y() += 5000.0;
  EXPECT_TRUE(path_.reaches(stamp_ns_ + 1, pose_));
  EXPECT_FALSE(path_.reaches(stamp_ns_ + 1, wrong));
  EXPECT_EQ(path_.add(stamp_ns_ + 1, wrong, covariance_, true), OnPath::kElsewhere);
  EXPECT_FALSE(path_.follows());
  EXPECT_FALSE(path_.goes_on(0.04, pose_, covariance_)) << "unknown from there";
  drive(1);
  EXPECT_FALSE(path_.follows());
  drive(1);
  EXPECT_TRUE(path_.follows());
}

TEST_F(OdometryPathTest, KnowsWhetherAPoseOfAnotherClockIsOnIt) {
  EXPECT_TRUE(path_.goes_on(0.2, pose_, covariance_)) << "nothing is known yet";
  drive(100);
  Eigen::Isometry3d later = pose_;
  later.translation().x() += 1.0;
  EXPECT_TRUE(path_.goes_on(0.2, later, covariance_));
  EXPECT_FALSE(path_.goes_on(0.2, Eigen::Isometry3d::Identity(), 1e-4 * Matrix6d::Identity())) << "restarted";
  later.translation().x() += 1000.0;
  EXPECT_FALSE(path_.goes_on(0.2, later, covariance_)) << "out of reach";
}

TEST_F(OdometryPathTest, GoesOnInAnotherTime) {
  drive(100);
  path_.set_clock_back(10'000'000'000);
  stamp_ns_ -= 10'000'000'000;
  drive(10);
  EXPECT_TRUE(path_.follows());
  EXPECT_NEAR(path_.velocity().x(), 5.0, 1e-6);
}

}  // namespace
}  // namespace panvo::vision
