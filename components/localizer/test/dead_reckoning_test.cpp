// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/dead_reckoning.hpp"

#include <gtest/gtest.h>

#include "drive.hpp"

namespace panvo::localizer {
namespace {

TEST(DeadReckoning, AddsNothingToWhatWasMeasured) {
  DeadReckoning dead_reckoning({}, 0.5);
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(dead_reckoning.step(0.04, true).isZero(0.0));
  DeadReckoning slow({}, 0.5);
  slow.step(2.0, true);
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(slow.step(2.0, true).isZero(0.0)) << "slow odometry is not a gap";
}

TEST(DeadReckoning, GrowsByTheTimeAndNotByTheNumberOfFrames) {
  DeadReckoning frames({}, 0.5), gap({}, 0.5);
  for (int i = 0; i < 10; ++i) frames.step(0.04, true), gap.step(0.04, true);
  vision::Matrix6d sum = vision::Matrix6d::Zero();
  for (int i = 0; i < 100; ++i) sum += frames.step(0.04, false);
  const vision::Matrix6d once = gap.step(4.0, true);
  EXPECT_TRUE(sum.isApprox(once, 1e-9)) << sum.diagonal().transpose() << " versus " << once.diagonal().transpose();
  EXPECT_NEAR(std::sqrt(once(0, 0)), 0.5 * 1.5 * 16.0, 1e-9);
}

TEST(DeadReckoning, TakesAGapForOneAlsoAfterALongerOne) {
  const vision::Matrix6d after_5_s = DeadReckoning({}, 0.5).silence(5.0);
  for (const int before : {0, 1, 100}) {
    DeadReckoning dead_reckoning({}, 0.5);
    for (int i = 0; i < before; ++i) dead_reckoning.step(0.04, true);
    dead_reckoning.step(3600.0, true);
    dead_reckoning.step(0.04, true);
    EXPECT_TRUE(dead_reckoning.step(5.0, true).isApprox(after_5_s, 1e-9)) << "after " << before << " steps";
  }
}

TEST(DeadReckoning, GetsUsedToOdometryThatHasBecomeSlower) {
  DeadReckoning dead_reckoning({}, 0.5);
  for (int i = 0; i < 100; ++i) dead_reckoning.step(0.04, true);
  int gaps = 0;
  for (int i = 0; i < 100; ++i) gaps += dead_reckoning.step(1.0, true).isZero(0.0) ? 0 : 1;
  EXPECT_EQ(gaps, 11) << "until they are half of the last intervals";
}

TEST(DeadReckoning, GoesOnAtASpeed) {
  DeadReckoning dead_reckoning({}, 0.5);
  EXPECT_NEAR(std::sqrt(dead_reckoning.silence(60.0)(0, 0)), 600.0, 1e-9);
}

TEST(AtLeast, IsTheLargerAlongEachDirection) {
  vision::Matrix6d covariance = vision::Matrix6d::Identity();
  covariance(0, 0) = 9.0;
  const vision::Matrix6d least = 4.0 * vision::Matrix6d::Identity();
  vision::Matrix6d expected = least;
  expected(0, 0) = 9.0;
  EXPECT_TRUE(at_least(covariance, least).isApprox(expected, 1e-12));
  EXPECT_TRUE(at_least(least, covariance).isApprox(expected, 1e-12));
}

/// Standard deviation of the position after 4 s without measurement, as unreliable frames or as one gap.
double sigma_after_4_s(bool in_frames) {
  Drive drive(5);
  Localizer localizer(of_known_scale());
  localizer.add(drive.now());
  for (int i = 0; i < 20; ++i) localizer.add(drive.step());
  const auto sure = drive.now();
  const int steps = static_cast<int>(4'000'000'000 / kPeriod_ns);
  auto blind = sure;
  for (int i = 1; i <= steps; ++i) {
    blind.stamp_ns += kPeriod_ns;
    blind.is_reliable = false;  // its covariance does not grow
    if (in_frames || i == steps) localizer.add(blind);
  }
  return vision::horizontal_sigma(localizer.latest().covariance);
}

TEST(Localizer, IsAsUncertainAfterFramesThatWereNotMeasuredAsAfterAGap) {
  EXPECT_GT(sigma_after_4_s(true), 10.0);
  EXPECT_NEAR(sigma_after_4_s(true), sigma_after_4_s(false), 0.2 * sigma_after_4_s(false));
}

TEST(Localizer, StaysUncertainUntilAPlaceIsSeen) {
  Round round(6);
  auto blind = round.drive.step();
  blind.stamp_ns += 4'000'000'000;
  blind.is_reliable = false;
  round.localizer.add(blind);
  auto next = blind;
  for (int i = 0; i < 100; ++i) {
    next.stamp_ns += kPeriod_ns;
    next.is_reliable = true;
    round.localizer.add(next);
  }
  EXPECT_GT(vision::horizontal_sigma(round.localizer.latest().covariance), 10.0);
  auto sighting = round.drive.sight(1, round.landmark);
  sighting.stamp_ns = next.stamp_ns;
  EXPECT_EQ(round.localizer.add(sighting).kind, CorrectionKind::kApplied);
  EXPECT_LT(vision::horizontal_sigma(round.localizer.latest().covariance), 0.5);
}

}  // namespace
}  // namespace panvo::localizer
