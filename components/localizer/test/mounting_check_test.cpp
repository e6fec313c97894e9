// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/mounting_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace panvo::localizer {
namespace {

/// Passes by landmarks, 12 m each, with sightings that err by 0.1 m, of a panoramic camera that is turned against what is said of it.
MountingCheck after_passes(int passes, double yaw_rad, double pitch_rad) {
  MountingCheck check;
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0.0, 0.1);
  const Eigen::Matrix3d turned =
      (Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()))
          .toRotationMatrix();
  for (int pass = 0; pass < passes; ++pass) {
    // the landmark was passed under another heading
    const Eigen::AngleAxisd heading(1.1 * pass, Eigen::Vector3d::UnitZ());
    for (int i = 0; i <= 12; ++i) {
      Remembered at;
      at.pose.odom_from_base.translation() = Eigen::Vector3d(100.0 * pass + i, 3.0, 0.0);
      LandmarkSighting sighting;
      sighting.landmark_id = static_cast<std::uint32_t>(pass + 1);
      Eigen::Isometry3d truth = Eigen::Isometry3d::Identity();
      truth.linear() = heading.toRotationMatrix();
      truth.translation() = heading * Eigen::Vector3d(i - 6.0, 1.0, 0.0);
      // what the camera tells, turned as it is: said_from_true * truth * true_from_said
      sighting.landmark_from_base.linear() = turned.transpose() * truth.linear() * turned;
      sighting.landmark_from_base.translation() =
          turned.transpose() * truth.translation() + Eigen::Vector3d(noise(random), noise(random), noise(random));
      check.add(sighting, at);
    }
  }
  return check;
}

constexpr double kDegree = M_PI / 180.0;

TEST(MountingCheck, FindsACameraThatIsTurnedByFiveDegrees) {
  const auto left = after_passes(3, 5.0 * kDegree, 0.0).misalignment();
  ASSERT_TRUE(left);
  EXPECT_NEAR(left->yaw_rad, 5.0 * kDegree, 1.0 * kDegree);
  EXPECT_NEAR(left->pitch_rad, 0.0, 1.0 * kDegree);
  const auto right = after_passes(3, -5.0 * kDegree, 0.0).misalignment();
  ASSERT_TRUE(right);
  EXPECT_NEAR(right->yaw_rad, -5.0 * kDegree, 1.0 * kDegree);
}

TEST(MountingCheck, FindsACameraThatIsTiltedByFiveDegrees) {
  const auto down = after_passes(3, 0.0, 5.0 * kDegree).misalignment();
  ASSERT_TRUE(down);
  EXPECT_NEAR(down->pitch_rad, 5.0 * kDegree, 1.0 * kDegree);
}

TEST(MountingCheck, FindsNothingInCamerasThatSitAsIsSaid) {
  for (int passes = 1; passes < 8; ++passes) EXPECT_FALSE(after_passes(passes, 0.0, 0.0).misalignment()) << passes;
}

TEST(MountingCheck, SaysNothingBeforeItHasSeenEnough) {
  EXPECT_FALSE(after_passes(1, 5.0 * kDegree, 0.0).misalignment());
}

}  // namespace
}  // namespace panvo::localizer
