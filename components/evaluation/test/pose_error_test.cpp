// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/pose_error.hpp"

#include <gtest/gtest.h>

#include "trajectories.hpp"

namespace panvo::evaluation {
namespace {

TEST(PoseErrors, AreZeroForThePathItself) {
  const auto errors = pose_errors(pairs_of(winding_path(40), winding_path(40)), {});
  EXPECT_LT(absolute_trajectory_error(errors)->max, 1e-12);
  EXPECT_LT(absolute_rotation_error_deg(errors)->max, 1e-6);
}

TEST(PoseErrors, GrowWithADriftPerMetre) {
  // 2 % too long: 0.02 m of error per metre. Over 0..10 m the mean is 0.1 m and the end 0.2 m.
  const auto errors = pose_errors(pairs_of(straight_line(11, 1.02), straight_line(11)), {});
  EXPECT_NEAR(errors.back().translation_m.x(), 0.2, 1e-12);
  EXPECT_NEAR(absolute_trajectory_error(errors)->mean, 0.1, 1e-12);
  EXPECT_NEAR(absolute_trajectory_error(errors)->max, 0.2, 1e-12);
  EXPECT_NEAR(errors.back().distance_m, 10.0, 1e-12);
}

TEST(PoseErrors, GiveAConstantHeadingErrorWithItsSign) {
  Trajectory estimate = straight_line(11);
  for (StampedPose& pose : estimate.poses) pose.world_from_base.linear() = make_pose(0, 0, 0, 0.1).linear();
  const auto errors = pose_errors(pairs_of(estimate, straight_line(11)), {});
  EXPECT_NEAR(errors[5].yaw_rad, 0.1, 1e-12);  // the estimate points to the left of the ground truth
  EXPECT_TRUE(errors[5].rotation_rad.isApprox(Eigen::Vector3d(0, 0, 0.1), 1e-12));
  EXPECT_NEAR(absolute_rotation_error_deg(errors)->mean, 0.1 * 180.0 / M_PI, 1e-9);
}

// With a heading error of 3 degrees at the start, the error at distance s is the chord 2 s sin(1.5 deg).
TEST(PoseErrors, OfAnOffsetInTheFirstHeadingGrowWithDistance) {
  const double offset = 3.0 * M_PI / 180.0;
  const auto pairs = pairs_of(transformed(straight_line(21), make_pose(0, 0, 0, offset)), straight_line(21));
  for (const PoseError& error : pose_errors(pairs, {})) {
    EXPECT_NEAR(error.translation_m.norm(), 2.0 * error.distance_m * std::sin(0.5 * offset), 1e-9);
  }
  EXPECT_LT(absolute_trajectory_error(pose_errors(pairs, *align(pairs, Alignment::kSe3)))->max, 1e-9);
}

TEST(RotationVector, KeepsTheDigitsOfTinyAngles) {
  const Eigen::Matrix3d tiny = make_pose(0, 0, 0, 1e-11).linear();
  EXPECT_NEAR(rotation_vector(tiny).z(), 1e-11, 1e-17);
}

}  // namespace
}  // namespace panvo::evaluation
