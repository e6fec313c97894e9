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

TEST(ProtectionFactor, IsExceededAsOftenAsIsStated) {
  // Student's t of two components: normal divided by the root of a chi-square over its degrees of freedom.
  constexpr double kTail = 10.0, kRisk = 0.01;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::chi_squared_distribution<double> chi_squared(kTail);
  constexpr int kDraws = 200'000;
  int exceeded = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double scale = std::sqrt(kTail / chi_squared(random));
    exceeded += std::hypot(scale * normal(random), scale * normal(random)) > protection_factor(kRisk, kTail) ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(exceeded) / kDraws, kRisk, 0.1 * kRisk);
}

TEST(ProtectionFactor, AlsoHoldsForNormalErrorsOfTwiceTheVariance) {
  EXPECT_GE(protection_factor(1e-3, 10.0), std::sqrt(2.0) * std::sqrt(-2.0 * std::log(1e-3)));
}

TEST(Integrity, AllowsTheUseOfASurePoseOnly) {
  const auto sure = assess(tracked(0.2), {}, {});
  EXPECT_TRUE(sure.is_usable);
  EXPECT_EQ(sure.reason, "");
  EXPECT_NEAR(sure.protection_level_m, 0.2 * protection_factor(1e-3, 10.0), 1e-12);
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
