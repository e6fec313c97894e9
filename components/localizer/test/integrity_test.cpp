// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/integrity.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "drive.hpp"

namespace panvo::localizer {
namespace {

using testing::HasSubstr;

LocalizedPose tracked(double sigma_m) {
  LocalizedPose pose;
  pose.state = State::kTracking;
  pose.covariance(0, 0) = pose.covariance(1, 1) = sigma_m * sigma_m;
  return pose;
}

Eigen::Matrix2d ellipse(double major_m, double minor_m, double turned_rad = 0.0) {
  const Eigen::Matrix2d axes = Eigen::Rotation2Dd(turned_rad).toRotationMatrix();
  return axes * Eigen::Vector2d(major_m * major_m, minor_m * minor_m).asDiagonal() * axes.transpose();
}

TEST(ProtectionRadius, IsExceededAsOftenAsIsStated) {
  // Student's t of two components: normal divided by the root of a chi-square over its degrees of freedom.
  constexpr double kTail = 10.0, kRisk = 0.01;
  for (const double minor_m : {2.0, 1.0, 0.5, 0.0}) {
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    std::chi_squared_distribution<double> chi_squared(kTail);
    const double radius_m = protection_radius(ellipse(2.0, minor_m, 0.7), kRisk, kTail);
    constexpr int kDraws = 200'000;
    int exceeded = 0;
    for (int i = 0; i < kDraws; ++i) {
      const double scale = std::sqrt(kTail / chi_squared(random));
      const Eigen::Vector2d error_m{2.0 * normal(random), minor_m * normal(random)};
      exceeded += scale * error_m.norm() > radius_m ? 1 : 0;
    }
    EXPECT_NEAR(static_cast<double>(exceeded) / kDraws, kRisk, 0.1 * kRisk) << minor_m;
  }
}

TEST(ProtectionRadius, IsThatOfTablesForACircleAndForALine) {
  EXPECT_NEAR(protection_radius(ellipse(1.0, 1.0), 1e-3, 10.0), std::sqrt(10.0 * (std::pow(1e-3, -0.2) - 1.0)), 1e-6);
  EXPECT_NEAR(protection_radius(ellipse(1.0, 0.0), 1e-3, 10.0), 4.587, 1e-3);  // Student's t, two-sided
  EXPECT_EQ(protection_radius(ellipse(0.0, 0.0), 1e-3, 10.0), 0.0);
}

TEST(ProtectionRadius, AlsoHoldsForNormalErrorsOfALargerVariance) {
  const double of_circle = std::sqrt(-2.0 * std::log(1e-3)), of_line = 3.2905;  // of a normal distribution
  for (const auto& [tail, ratio] : {std::pair(10.0, 1.9), std::pair(30.0, 1.2)}) {
    EXPECT_GE(protection_radius(ellipse(1.0, 1.0), 1e-3, tail), std::sqrt(ratio) * of_circle);
    EXPECT_GE(protection_radius(ellipse(1.0, 0.0), 1e-3, tail), std::sqrt(ratio) * of_line);
  }
}

TEST(Integrity, AllowsTheUseOfASurePoseOnly) {
  const auto sure = assess(tracked(0.2), {}, {});
  EXPECT_TRUE(sure.is_usable);
  EXPECT_EQ(sure.reason, "");
  EXPECT_NEAR(sure.protection_level_m, protection_radius(ellipse(0.2, 0.2), 1e-3, 30.0), 1e-12);
  const auto unsure = assess(tracked(1.0), {}, {});
  EXPECT_FALSE(unsure.is_usable);
  EXPECT_THAT(unsure.reason, HasSubstr("alert limit of 2.00 m"));
}

TEST(Integrity, ForbidsTheUseInEveryStateButThoseInWhichItIsKnown) {
  for (const State state : {State::kStarting, State::kUnlocated, State::kCompassOnly, State::kLost, State::kStale}) {
    auto pose = tracked(0.01);
    pose.state = state;
    pose.reason = "why";
    EXPECT_EQ(assess(pose, {}, {}).reason, to_text(state) + ": why");
    EXPECT_FALSE(assess(pose, {}, {}).is_usable);
  }
}

TEST(Integrity, AddsWhatNoCovarianceKnowsOf) {
  const double level_m = assess(tracked(0.1), {}, {}).protection_level_m;
  const auto contradicted = assess(tracked(0.1), {{0.3, false, "compass"}}, {});
  EXPECT_NEAR(contradicted.protection_level_m, level_m + 0.3, 1e-12);
  EXPECT_TRUE(contradicted.is_usable);
  const auto moved = assess(tracked(0.1), {{0.3, true, "a landmark"}}, {});
  EXPECT_FALSE(moved.is_usable);
  EXPECT_EQ(moved.reason, "a landmark");
}

TEST(Integrity, CoversAVehicleThatWasMovedAsSoonAsOneLandmarkSaysSo) {
  IntegrityParameters generous;
  generous.alert_limit_m = 20.0;
  Drive drive(15);
  Localizer localizer({});
  localizer.add(drive.now());
  for (int i = 0; i < 30; ++i) localizer.add(drive.step());
  const Eigen::Isometry3d place = drive.truth;
  ASSERT_TRUE(localizer.add_built(1, drive.now().stamp_ns));
  for (int i = 0; i < 30; ++i) localizer.add(drive.step());
  localizer.add(drive.step(0.0, 25.0));  // not noticed by odometry
  EXPECT_TRUE(assess(localizer.latest(), localizer.doubts(), generous).is_usable) << "not detected yet";
  ASSERT_EQ(localizer.add(drive.sight(1, place)).kind, CorrectionKind::kRejected);
  const auto integrity = assess(localizer.latest(), localizer.doubts(), generous);
  EXPECT_FALSE(integrity.is_usable);
  EXPECT_GT(integrity.protection_level_m, error_m(localizer.latest(), drive));
}

}  // namespace
}  // namespace panvo::localizer
