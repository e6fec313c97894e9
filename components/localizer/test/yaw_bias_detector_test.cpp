// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/yaw_bias_detector.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace panvo::localizer {
namespace {

constexpr std::int64_t kInterval_ns = 400'000'000;

YawBiasDetector::Stretch turn(int i, double disagreement_rad) {
  return {i * kInterval_ns, (i + 1) * kInterval_ns, disagreement_rad, 0.1, 1e-6, 1e-6};
}

TEST(YawBiasDetector, IsNoneWhereErrorsAreOfBothSigns) {
  YawBiasDetector lean(6.0, 3.0);
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(lean.add(turn(i, i % 2 == 0 ? 0.002 : -0.002))) << i;
}

TEST(YawBiasDetector, IsSeenInErrorsThatAreSmallButAllToOneSide) {
  YawBiasDetector lean(6.0, 3.0);
  int seen_at = -1;
  for (int i = 0; i < 15 && seen_at < 0; ++i) {
    const auto found = lean.add(turn(i, 0.0017));  // 1.2 standard deviations each
    if (!found) continue;
    seen_at = i;
    EXPECT_EQ(found->uncorrected.from_ns, 0);
    EXPECT_EQ(found->uncorrected.to_ns, (i + 1) * kInterval_ns);
    EXPECT_NEAR(found->uncorrected.disagreement_rad, 0.0017 * (i + 1), 1e-12);
    EXPECT_NEAR(found->uncorrected.compass_rad, 0.1 * (i + 1), 1e-12);
    EXPECT_NEAR(found->excess, std::pow(0.0017 * (i + 1), 2) / (1e-6 * (i + 1)), 1e-9);
  }
  EXPECT_GE(seen_at, 4);
  EXPECT_LE(seen_at, 8);
}

TEST(YawBiasDetector, GivesEachTurnOfALastingBiasOnceToBeCorrected) {
  YawBiasDetector lean(6.0, 3.0);
  std::int64_t corrected_until_ns = 0;
  for (int i = 0; i < 60; ++i) {
    const auto found = lean.add(turn(i, 0.0017));
    if (!found) continue;
    EXPECT_EQ(found->uncorrected.from_ns, corrected_until_ns);
    corrected_until_ns = found->uncorrected.to_ns;
  }
  EXPECT_EQ(corrected_until_ns, 60 * kInterval_ns);
}

TEST(YawBiasDetector, GivesOnlyTheNewestTurnAgainIfAnotherAgainstItsReferenceReplacesIt) {
  YawBiasDetector lean(6.0, 3.0);
  int i = 0;
  while (!lean.add(turn(i, 0.0017))) ++i;
  for (int again = 0; again < 3; ++again) {
    const auto found = lean.add(turn(i, 0.0017));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->uncorrected.from_ns, i * kInterval_ns);
  }
}

TEST(YawBiasDetector, CountsTheLastOfSeveralTurnsAgainstOnePanorama) {
  YawBiasDetector lean(6.0, 3.0);
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(lean.add(turn(0, 0.003))) << i;
}

TEST(YawBiasDetector, BeginsAnewAfterAGap) {
  YawBiasDetector lean(6.0, 3.0);
  for (int i = 0; i < 3; ++i) lean.add(turn(i, 0.0017));
  for (int i = 5; i < 8; ++i) EXPECT_FALSE(lean.add(turn(i, 0.0017)));
}

}  // namespace
}  // namespace panvo::localizer
