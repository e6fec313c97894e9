// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/drifting_odometry.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

namespace panvo::simulation {
namespace {

/// A pose on a circle of 300 m, one metre per step.
Eigen::Isometry3d truth(int step) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const double turn = step * 2.0 * M_PI / 300.0;
  const double radius = 300.0 / (2.0 * M_PI);
  pose.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, turn));
  pose.translation() = radius * Eigen::Vector3d(std::sin(turn), 1.0 - std::cos(turn), 0.0);
  return pose;
}

TEST(DriftingOdometry, ErrsAsItsCovarianceSays) {
  double nees = 0.0;
  constexpr int kTrials = 100;
  for (unsigned seed = 0; seed < kTrials; ++seed) {
    DriftingOdometry odometry({}, seed);
    DriftingOdometry::Pose pose;
    for (int i = 0; i <= 200; ++i) pose = odometry.step(truth(i));
    const auto error = vision::pose_error(pose.odom_from_base, truth(200));
    nees += error.dot(pose.covariance.ldlt().solve(error)) / 6.0 / kTrials;
  }
  EXPECT_NEAR(nees, 1.0, 0.25);
}

TEST(DriftingOdometry, IsTooLongByItsScale) {
  DriftParameters exact{.motion_error_ratio = 0.0, .rotation_error_rad_per_m = 0.0};
  exact.scale_error = 0.02;
  DriftingOdometry odometry(exact, 1);
  DriftingOdometry::Pose pose;
  for (int i = 0; i <= 100; ++i) pose = odometry.step(truth(i));
  EXPECT_NEAR(pose.odom_from_base.translation().norm(), 1.02 * truth(100).translation().norm(), 0.05);
}

TEST(DriftingOdometry, IsTheSameForTheSameSeed) {
  DriftingOdometry a({}, 7);
  DriftingOdometry b({}, 7);
  DriftingOdometry c({}, 8);
  for (int i = 0; i < 50; ++i) {
    const auto pose = a.step(truth(i));
    EXPECT_EQ(pose.odom_from_base.matrix(), b.step(truth(i)).odom_from_base.matrix());
    const auto other = c.step(truth(i));
    if (i > 0) {
      EXPECT_NE(pose.odom_from_base.matrix(), other.odom_from_base.matrix());
    }
  }
}

}  // namespace
}  // namespace panvo::simulation
