// SPDX-License-Identifier: Apache-2.0
#include "panvo/all_round_odometry/panorama_points.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "panvo/vision/pose.hpp"

namespace panvo::all_round_odometry {
namespace {

PanoramaPoints after_turn(double turn_rad) {
  PanoramaPoints panorama;
  panorama.now_from_then = vision::so3_exp({0.0, 0.0, turn_rad}).transpose();
  panorama.tracks.resize(1);
  return panorama;
}

TEST(PanoramaPoints, TellByHowMuchTurnsDifferAlsoWhenTheVehicleTurnsAround) {
  constexpr double kHalf = std::numbers::pi;
  EXPECT_NEAR(turn_in(after_turn(0.4)), 0.4, 1e-9);
  EXPECT_NEAR(turn_beyond(0.3, after_turn(0.4)), 0.1, 1e-9);
  EXPECT_NEAR(turn_beyond(-0.3, after_turn(-0.5)), -0.2, 1e-9);
  EXPECT_NEAR(turn_beyond(kHalf - 0.004, after_turn(kHalf + 0.006)), 0.01, 1e-9);
  EXPECT_NEAR(turn_beyond(0.004 - kHalf, after_turn(kHalf - 0.006)), -0.01, 1e-9);
}

}  // namespace
}  // namespace panvo::all_round_odometry
