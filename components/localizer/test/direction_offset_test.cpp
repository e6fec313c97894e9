// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/direction_offset.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace panvo::localizer {
namespace {

TEST(DirectionOffset, FindsAConstantAngleAndSaysHowWell) {
  constexpr double kOffset_rad = 0.05, kSigma_rad = 0.02;
  double nees = 0.0;
  constexpr int kTrials = 200;
  for (unsigned seed = 0; seed < kTrials; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> noise(0.0, kSigma_rad);
    DirectionOffset offset(0.5);
    for (int i = 0; i < 30; ++i) offset.add(kOffset_rad + noise(random), kSigma_rad * kSigma_rad);
    const double error_rad = offset.estimate_rad() - kOffset_rad;
    EXPECT_LT(std::abs(error_rad), 0.02);
    nees += error_rad * error_rad / offset.variance_rad2() / kTrials;
  }
  EXPECT_NEAR(nees, 1.0, 0.3);
}

TEST(DirectionOffset, StaysReadyToFollowAMountThatGives) {
  DirectionOffset offset(0.02);
  for (int i = 0; i < 100'000; ++i) offset.add(0.0, 1e-4);
  EXPECT_GE(offset.variance_rad2(), 1e-6);
  for (int i = 0; i < 1000; ++i) offset.add(0.02, 1e-4);
  EXPECT_NEAR(offset.estimate_rad(), 0.02, 0.001);
}

TEST(DirectionOffset, KnowsThatHalfATurnToTheLeftIsOneToTheRight) {
  DirectionOffset offset(1.0);
  for (int i = 0; i < 50; ++i) offset.add(i % 2 == 0 ? 3.13 : -3.13, 1e-4);
  EXPECT_GT(std::abs(offset.estimate_rad()), 3.1);
}

TEST(DirectionOffset, KnowsFromTheBeginningWhatIsSaidToBeExact) {
  DirectionOffset offset(0.0);
  offset.add(0.1, 1e-4);
  EXPECT_EQ(offset.estimate_rad(), 0.0);
  EXPECT_EQ(offset.variance_rad2(), 0.0);
}

TEST(DirectionOffset, ForgetsWhatAnEarlierJourneyFoundAsIfItHadNever) {
  DirectionOffset offset(0.5);
  offset.remember(0.1, 1e-4);
  EXPECT_FALSE(offset.is_measured());
  EXPECT_EQ(offset.estimate_rad(), 0.1);
  offset.forget_memory();
  EXPECT_FALSE(offset.is_only_remembered());
  EXPECT_EQ(offset.estimate_rad(), 0.0);
  EXPECT_EQ(offset.variance_rad2(), 0.25);
  offset.remember(0.1, 1e-4);
  offset.add(0.1, 1e-4);
  EXPECT_FALSE(offset.is_only_remembered());
}

}  // namespace
}  // namespace panvo::localizer
