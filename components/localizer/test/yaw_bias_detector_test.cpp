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
  double corrected_rad = 0.0, before_reference_rad = 0.0;
  constexpr int kTurns = 60;
  for (int i = 0; i < kTurns; ++i) {
    before_reference_rad = corrected_rad;
    for (const double part : {0.5, 1.0}) {  // two panoramas against one reference; the second replaces the first
      auto now = turn(i, part * 0.0017);
      now.to_ns = now.from_ns + static_cast<std::int64_t>(part * kInterval_ns);
      const auto found = lean.add(now);
      if (!found) continue;
      if (found->uncorrected.from_ns == now.from_ns) {
        corrected_rad = before_reference_rad;  // as the correction of the first is taken back
        EXPECT_EQ(found->uncorrected.to_ns, now.to_ns);
      } else {
        EXPECT_EQ(before_reference_rad, 0.0) << "the whole stretch, when the bias is noticed";
      }
      corrected_rad += found->uncorrected.disagreement_rad;
      if (part == 0.5 && found->uncorrected.from_ns != now.from_ns) before_reference_rad = corrected_rad - 0.5 * 0.0017;
    }
  }
  EXPECT_NEAR(corrected_rad, kTurns * 0.0017, 1e-9);
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
