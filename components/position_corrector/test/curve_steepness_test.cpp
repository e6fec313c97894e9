// SPDX-License-Identifier: Apache-2.0
#include "panvo/position_corrector/curve_steepness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace panvo::position_corrector {
namespace {

/// A curve with a sample every 0.4 m.
template <class Distance>
std::vector<DistanceSample> curve(double from_m, double to_m, Distance distance) {
  std::vector<DistanceSample> samples;
  for (double way_m = from_m; way_m <= to_m; way_m += 0.4) samples.push_back({way_m, distance(way_m)});
  return samples;
}

double vee(double way_m) { return 0.2 + 0.15 * std::abs(way_m - 50.0); }

// [Lu2015 5.2]
TEST(CurveSteepness, IsTheSlopeOfACurveThatFallsAndRisesEvenly) {
  const auto slope = curve_slope(curve(46.0, 54.01, vee), 3.0);
  ASSERT_TRUE(slope);
  EXPECT_NEAR(*slope, 0.15, 1e-9);
}

// [Lu2015 5.2]
TEST(CurveSteepness, IsThatOfOneSideWhereTheOtherWasNotSeen) {
  const auto slope = curve_slope(curve(50.0, 54.01, vee), 3.0);
  ASSERT_TRUE(slope);
  EXPECT_NEAR(*slope, 0.15, 1e-9);
}

// [Lu2015 5.2]
TEST(CurveSteepness, IsThatNearTheMinimum) {
  const auto kinked = [](double way_m) { return std::min(0.65, vee(way_m)); };  // another place beyond 3 m
  const auto slope = curve_slope(curve(40.0, 60.01, kinked), 3.0);
  ASSERT_TRUE(slope);
  EXPECT_NEAR(*slope, 0.15, 1e-9);
}

// [Lu2015 5.2]
TEST(CurveSteepness, TellsALandmarkPassedThroughFromOnePassedAtADistance) {
  // a uniform scene: D is proportional to the distance from the landmark, up to a limit
  const auto passed = [](double beside_m) {
    return curve(40.0, 60.0,
                 [beside_m](double way_m) { return std::min(0.9, 0.15 + 0.15 * std::hypot(way_m - 50.0, beside_m)); });
  };
  const SteepnessParameters parameters;
  EXPECT_TRUE(is_steep(passed(0.0), parameters));
  EXPECT_FALSE(is_steep(passed(4.5), parameters));
  EXPECT_FALSE(is_steep(curve(40.0, 60.0, [](double) { return 0.7; }), parameters));
}

// [Lu2015 5.2]
TEST(CurveSteepness, SaysNothingOfACurveThatIsTooShort) {
  EXPECT_FALSE(curve_slope({}, 3.0));
  EXPECT_FALSE(curve_slope(curve(50.0, 51.0, vee), 3.0)) << "three samples";
  std::vector<DistanceSample> standing(20, {50.0, 0.2});
  standing.front().distance = 0.4;
  EXPECT_FALSE(curve_slope(standing, 3.0));
  EXPECT_FALSE(is_steep(standing, {}));
}

}  // namespace
}  // namespace panvo::position_corrector
