// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/dispute.hpp"

#include <gtest/gtest.h>

namespace panvo::localizer {
namespace {

constexpr Blame kOdometry{Wrong::kOdometry, 0.0};

TEST(Dispute, AddsUpWhatDiffersNotItsSquares) {
  Dispute dispute;
  double variance = 0.0;
  for (int i = 1; i <= 10; ++i) {
    dispute.add(i - 1, i, 0.2, kOdometry);
    variance += dispute.growth(1.0);
  }
  EXPECT_DOUBLE_EQ(dispute.total(), 2.0);
  EXPECT_NEAR(variance, 4.0, 1e-12) << "the full variance, although added in ten parts";
}

TEST(Dispute, CountsOnlyTheLastOfOneReference) {
  Dispute dispute;
  dispute.add(0, 1, 0.5, kOdometry);
  dispute.add(0, 2, 0.8, kOdometry);
  EXPECT_DOUBLE_EQ(dispute.total(), 0.8);
  dispute.add(2, 3, 0.1, kOdometry);
  EXPECT_DOUBLE_EQ(dispute.total(), 0.9);
  EXPECT_NEAR(dispute.growth(0.5), 0.5 * (0.81 - 0.64), 1e-12) << "of the stretch since the reference";
}

TEST(Dispute, MakesNothingSurerThatGoesBack) {
  Dispute dispute;
  dispute.add(0, 1, 0.5, kOdometry);
  dispute.add(1, 2, -0.4, kOdometry);
  EXPECT_EQ(dispute.growth(1.0), 0.0);
}

TEST(Dispute, BlamesTheSameSideUntilItEnds) {
  Dispute dispute;
  EXPECT_FALSE(dispute.is_on());
  dispute.add(0, 1, 0.5, {Wrong::kPanoramas, 0.25});
  dispute.add(1, 2, 0.5, kOdometry);
  EXPECT_TRUE(dispute.is_on());
  EXPECT_EQ(dispute.blame().wrong, Wrong::kPanoramas);
  EXPECT_EQ(dispute.blame().doubt, 0.25);
  dispute.end();
  EXPECT_FALSE(dispute.is_on());
  dispute.add(5, 6, 0.3, kOdometry);
  EXPECT_EQ(dispute.blame().wrong, Wrong::kOdometry);
  EXPECT_DOUBLE_EQ(dispute.total(), 0.3) << "restarted";
}

}  // namespace
}  // namespace panvo::localizer
