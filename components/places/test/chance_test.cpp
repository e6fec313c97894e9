// SPDX-License-Identifier: Apache-2.0
#include "panvo/places/chance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace panvo::places {
namespace {

TEST(LeastExpected, CountsHypothesesSubsetsAndSamples) {
  // n = 3, s = 2: only k = 3 can be tested: (n - s) C(3, 3) C(3, 2) p^1 = 3 p
  const auto consensus = least_expected(std::vector<double>{0.001, 0.01, 0.002}, 2, 1.0);
  EXPECT_NEAR(consensus.log10_expected, std::log10(3.0 * 0.01) + 1.0, 1e-9);
  EXPECT_EQ(consensus.size, 3);
  EXPECT_EQ(consensus.probability, 0.01);
}

TEST(LeastExpected, ChoosesTheSubsetThatChanceExplainsLeast) {
  std::vector<double> probabilities(20, 0.9);
  std::fill_n(probabilities.begin(), 10, 0.01);
  const auto consensus = least_expected(probabilities, 2, 0.0);
  EXPECT_EQ(consensus.size, 10);
  EXPECT_LT(consensus.log10_expected, -7.0);
}

TEST(LeastExpected, IsNothingForContradictionsAndTooFewMatches) {
  EXPECT_EQ(least_expected(std::vector<double>(50, 1.0), 3, 0.0).log10_expected, 0.0);
  EXPECT_EQ(least_expected(std::vector<double>{1e-6, 1e-6}, 2, 0.0).log10_expected, 0.0);
}

TEST(LeastExpected, IsReachedByChanceNoMoreOftenThanItSays) {
  constexpr int kTrials = 4000;
  std::mt19937_64 random(3);
  int below_tenth = 0, below_thousandth = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> probabilities(60);
    for (double& p : probabilities) p = static_cast<double>(random() >> 11U) * 0x1p-53;
    const double log10_expected = least_expected(probabilities, 3, 0.0).log10_expected;
    below_tenth += log10_expected < -1.0 ? 1 : 0;
    below_thousandth += log10_expected < -3.0 ? 1 : 0;
  }
  EXPECT_LE(below_tenth, kTrials / 10);
  EXPECT_LE(below_thousandth, kTrials / 1000);
}

}  // namespace
}  // namespace panvo::places
