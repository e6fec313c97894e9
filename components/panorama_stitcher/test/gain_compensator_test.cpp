// SPDX-License-Identifier: Apache-2.0
#include "panvo/panorama_stitcher/gain_compensator.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace panvo::panorama_stitcher {
namespace {

void settle(GainCompensator& gains, const std::vector<GainCompensator::Overlap>& overlaps) {
  for (int i = 0; i < 400; ++i) gains.update(overlaps);
}

TEST(GainCompensator, MakesTwoHeadsAlike) {
  GainCompensator gains(2, {});
  settle(gains, {{0, 1, 100'000.0, 64'000.0, 1000}});
  EXPECT_NEAR(gains.gain(1) / gains.gain(0), 100.0 / 64.0, 1e-4);
  EXPECT_NEAR(gains.gain(1) * gains.gain(0), 1.0, 1e-4) << "one is darkened as the other is brightened";
}

TEST(GainCompensator, GoesAShareOfTheWayEachTime) {
  GainCompensator gains(2, {0.1, 4.0});
  gains.update({{0, 1, 100.0 * 121.0, 100.0 * 100.0, 100}});
  EXPECT_NEAR(gains.gain(1), std::pow(1.1, 0.1), 1e-6);
}

TEST(GainCompensator, StaysWithinItsLimit) {
  GainCompensator gains(2, {0.5, 1.5});
  settle(gains, {{0, 1, 1e6, 1e4, 1000}});
  EXPECT_NEAR(gains.gain(1), 1.5, 1e-9);
  EXPECT_NEAR(gains.gain(0), 1.0 / 1.5, 1e-9);
}

TEST(GainCompensator, LeavesAHeadAloneThatMeetsNoOther) {
  GainCompensator gains(3, {});
  settle(gains, {{0, 1, 1000.0, 2000.0, 100}});
  EXPECT_NEAR(gains.gain(2), 1.0, 1e-9);
}

TEST(GainCompensator, IsNotMovedByAHandfulOfPixels) {
  GainCompensator gains(2, {});
  settle(gains, {{0, 1, 1000.0, 100.0, 5}});
  EXPECT_EQ(gains.gain(0), 1.0);
}

/// Around a ring the ratios may be inconsistent; the error is distributed.
TEST(GainCompensator, SpreadsWhatDoesNotAgree) {
  GainCompensator gains(3, {});
  settle(gains, {{0, 1, 1100.0, 1000.0, 100}, {1, 2, 1100.0, 1000.0, 100}, {2, 0, 1100.0, 1000.0, 100}});
  for (std::size_t head = 0; head < 3; ++head) EXPECT_NEAR(gains.gain(head), 1.0, 1e-9);
}

}  // namespace
}  // namespace panvo::panorama_stitcher
