// SPDX-License-Identifier: Apache-2.0
#include "panvo/binocular_odometry/base_motion.hpp"

#include <gtest/gtest.h>

namespace panvo::binocular_odometry {
namespace {

const Eigen::Isometry3d kOneMetreAhead(Eigen::Translation3d(1.0, 0.0, 0.0));

TEST(MotionOfBase, OfATurnOnTheSpotHasNoTranslation) {
  const Eigen::Isometry3d turn(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()));
  const Eigen::Isometry3d motion_of_left = kOneMetreAhead.inverse() * turn * kOneMetreAhead;
  ASSERT_GT(motion_of_left.translation().norm(), 0.4);
  const auto motion = motion_of_base(kOneMetreAhead, motion_of_left, vision::Matrix6d::Zero());
  EXPECT_TRUE(motion.pose.isApprox(turn, 1e-12));
  EXPECT_TRUE(motion.covariance.isZero(1e-12));
}

TEST(MotionOfBase, HasTheUncertaintyOfTheLeverArm) {
  constexpr double kYaw_rad2 = 0.01;
  vision::Matrix6d covariance = vision::Matrix6d::Zero();
  covariance(5, 5) = kYaw_rad2;
  const auto motion = motion_of_base(kOneMetreAhead, Eigen::Isometry3d::Identity(), covariance);
  EXPECT_TRUE(motion.pose.isApprox(Eigen::Isometry3d::Identity(), 1e-12));
  vision::Matrix6d expected = covariance;  // a turn to the left moves the base, 1 m behind the camera, to the right
  expected(1, 1) = kYaw_rad2;
  expected(1, 5) = expected(5, 1) = -kYaw_rad2;
  EXPECT_TRUE(motion.covariance.isApprox(expected, 1e-12)) << motion.covariance;
}

}  // namespace
}  // namespace panvo::binocular_odometry
