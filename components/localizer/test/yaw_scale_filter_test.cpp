// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/yaw_scale_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace panvo::localizer {
namespace {

TEST(YawScaleFilter, LearnsOnlyFromTurns) {
  YawScaleFilter scale(0.003);
  for (int i = 0; i < 100; ++i) scale.add(0.001, 0.01, 1e-6);
  EXPECT_EQ(scale.estimate(), 0.0);
  EXPECT_NEAR(scale.variance(), 9e-6, 1e-12);
}

TEST(YawScaleFilter, IsWhatExplainsTheDisagreementAsSureAsItSays) {
  constexpr double kSigma_rad = 7e-4;
  double nees = 0.0;
  constexpr int kJourneys = 200;
  for (int journey = 0; journey < kJourneys; ++journey) {
    std::mt19937_64 random(static_cast<unsigned>(journey));
    std::normal_distribution<double> normal;
    const double truth = 0.003 * normal(random);
    YawScaleFilter scale(0.003);
    for (int i = 0; i < 12; ++i) {  // 0.1 rad each, alternately left and right
      const double turn = i % 3 == 0 ? -0.1 : 0.1;
      scale.add(-(truth - scale.estimate()) * turn + kSigma_rad * normal(random), turn, kSigma_rad * kSigma_rad);
    }
    nees += std::pow(scale.estimate() - truth, 2) / scale.variance();
  }
  EXPECT_NEAR(nees / kJourneys, 1.0, 0.2);
}

TEST(YawScaleFilter, IsNeverSurerThanTheCompassSees) {
  YawScaleFilter scale(0.003);
  for (int i = 0; i < 1000; ++i) scale.add(0.0, 0.3, 1e-6);
  EXPECT_DOUBLE_EQ(std::sqrt(scale.variance()), 0.001);
}

TEST(YawScaleFilter, IsNotMovedByAMeasurementThatIsWrong) {
  YawScaleFilter scale(0.003);
  scale.add(0.2, 0.3, 1e-6);
  EXPECT_EQ(scale.estimate(), 0.0);
}

TEST(YawScaleFilter, OfFocalLengthsThatAreRightIsNone) {
  YawScaleFilter scale(0.0);
  for (int i = 0; i < 10; ++i) scale.add(0.001, 0.5, 1e-6);
  EXPECT_EQ(scale.estimate(), 0.0);
}

}  // namespace
}  // namespace panvo::localizer
