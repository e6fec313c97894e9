// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/extrinsics_monitor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "panvo/vision/angle.hpp"

namespace panvo::localizer {
namespace {

constexpr double kSighting_m = 0.07;

struct Mounted {  // deviation of the panoramic camera from its extrinsics
  double yaw_rad = 0.0, pitch_rad = 0.0;
  double forward_m = 0.0, left_m = 0.0;
};

/// Passes by landmarks, 12 m each, in which the vehicle turns by `turn_rad` to the left, to the right and not at all in
/// turn; sightings err by kSighting_m.
ExtrinsicsMonitor after_passes(int passes, const Mounted& mounted, double turn_rad = 0.0) {
  ExtrinsicsMonitor check;
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0.0, kSighting_m);
  Eigen::Isometry3d true_from_said = Eigen::Isometry3d::Identity();
  true_from_said.linear() = (Eigen::AngleAxisd(mounted.yaw_rad, Eigen::Vector3d::UnitZ()) *
                             Eigen::AngleAxisd(mounted.pitch_rad, Eigen::Vector3d::UnitY()))
                                .toRotationMatrix();
  true_from_said.translation() = Eigen::Vector3d(mounted.forward_m, mounted.left_m, 0.0);
  OdometrySample at;
  for (int pass = 0; pass < passes; ++pass) {
    // each landmark was built at another heading
    const Eigen::AngleAxisd heading(1.1 * pass, Eigen::Vector3d::UnitZ());
    Eigen::Isometry3d truth = Eigen::Isometry3d::Identity();
    truth.linear() = heading.toRotationMatrix();
    truth.translation() = heading * Eigen::Vector3d(-6.0, 1.0, 0.0);
    const double turn_here_rad = pass % 3 == 0 ? turn_rad : pass % 3 == 1 ? -turn_rad : 0.0;
    for (int i = 0; i <= 12; ++i) {
      if (i > 0) {
        Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
        step.translation().x() = 1.0;
        step.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, turn_here_rad / 12.0));
        truth = truth * step;
        at.pose.odom_from_base = at.pose.odom_from_base * step;
        at.way_m += 1.0;
      }
      LandmarkSighting sighting;
      sighting.landmark_id = static_cast<std::uint32_t>(pass + 1);
      sighting.landmark_from_base = true_from_said.inverse() * truth * true_from_said;
      sighting.landmark_from_base.translation() += Eigen::Vector3d{noise(random), noise(random), noise(random)};
      sighting.covariance.topLeftCorner<3, 3>() = kSighting_m * kSighting_m * Eigen::Matrix3d::Identity();
      check.add(sighting, at);
    }
    at.way_m += 100.0;
  }
  return check;
}

constexpr double kQuarterTurn = M_PI / 2.0;

TEST(ExtrinsicsMonitor, FindsACameraThatIsTurnedByFiveDegrees) {
  for (const double sign : {1.0, -1.0}) {
    const auto found = after_passes(3, {.yaw_rad = sign * 5.0 * vision::kDegree}).misalignment();
    ASSERT_TRUE(found && found->is_turned);
    EXPECT_NEAR(found->yaw_rad, sign * 5.0 * vision::kDegree, 1.0 * vision::kDegree);
    EXPECT_NEAR(found->pitch_rad, 0.0, 1.0 * vision::kDegree);
    EXPECT_FALSE(found->is_displaced);
  }
}

TEST(ExtrinsicsMonitor, FindsACameraThatIsTiltedByFiveDegrees) {
  const auto down = after_passes(3, {.pitch_rad = 5.0 * vision::kDegree}).misalignment();
  ASSERT_TRUE(down && down->is_turned);
  EXPECT_NEAR(down->pitch_rad, 5.0 * vision::kDegree, 1.0 * vision::kDegree);
}

TEST(ExtrinsicsMonitor, FindsACameraThatSitsElsewhereByWhereItSwingsInTurns) {
  const auto found = after_passes(9, {.forward_m = -0.16, .left_m = 0.12}, kQuarterTurn).misalignment();
  ASSERT_TRUE(found && found->is_displaced);
  EXPECT_NEAR(found->forward_m, -0.16, 0.05);
  EXPECT_NEAR(found->left_m, 0.12, 0.05);
  EXPECT_FALSE(found->is_turned);
}

TEST(ExtrinsicsMonitor, TellsTurnedFromDisplaced) {
  const auto found = after_passes(8, {.yaw_rad = 5.0 * vision::kDegree, .left_m = 0.2}, kQuarterTurn).misalignment();
  ASSERT_TRUE(found && found->is_turned && found->is_displaced);
  EXPECT_NEAR(found->yaw_rad, 5.0 * vision::kDegree, 1.0 * vision::kDegree);
  EXPECT_NEAR(found->left_m, 0.2, 0.06);
}

TEST(ExtrinsicsMonitor, FindsNothingInCamerasThatSitAsIsSaid) {
  for (int passes = 1; passes < 8; ++passes) {
    EXPECT_FALSE(after_passes(passes, {}).misalignment()) << passes;
    EXPECT_FALSE(after_passes(passes, {}, kQuarterTurn).misalignment()) << passes;
  }
}

TEST(ExtrinsicsMonitor, SaysNothingOfWhatItCannotHaveSeen) {
  // on a straight road a displacement is not observable
  EXPECT_FALSE(after_passes(8, {.left_m = 0.5}).misalignment());
  // in a single curve, a forward displacement looks like a rotation
  EXPECT_FALSE(after_passes(1, {.forward_m = 0.3}, kQuarterTurn).misalignment());
}

}  // namespace
}  // namespace panvo::localizer
