// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace panvo::evaluation {
namespace {

TEST(Summary, HasTheFiguresOfASmallSample) {
  const auto summary = summarize({4.0, 1.0, 2.0, 3.0});
  ASSERT_TRUE(summary);
  EXPECT_EQ(summary->count, 4u);
  EXPECT_DOUBLE_EQ(summary->mean, 2.5);
  EXPECT_DOUBLE_EQ(summary->rmse, std::sqrt(30.0 / 4.0));
  EXPECT_DOUBLE_EQ(summary->median, 2.5);
  EXPECT_DOUBLE_EQ(summary->max, 4.0);
}

TEST(Summary, TakesTheMiddleOfAnOddSample) { EXPECT_DOUBLE_EQ(summarize({9.0, 1.0, 2.0})->median, 2.0); }

TEST(Summary, IsAbsentForNoValues) { EXPECT_FALSE(summarize({})); }

TEST(ChiSquareQuantile, AgreesWithPrintedTables) {
  EXPECT_NEAR(chi_square_quantile(6, 0.025), 1.2373, 1e-4);
  EXPECT_NEAR(chi_square_quantile(6, 0.975), 14.4494, 1e-4);
  EXPECT_NEAR(chi_square_quantile(3, 0.95), 7.8147, 1e-4);
  EXPECT_NEAR(chi_square_quantile(1, 0.95), 3.8415, 1e-4);
  EXPECT_NEAR(chi_square_quantile(100, 0.05), 77.9295, 1e-4);
}

TEST(ChiSquareQuantile, ApproachesTheNormalDistributionForManySamples) {
  const double k = 60000.0;
  EXPECT_NEAR((chi_square_quantile(k, 0.975) - k) / std::sqrt(2.0 * k), 1.96, 0.01);
}

}  // namespace
}  // namespace panvo::evaluation
