// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/mounting_history.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace panvo::localizer {
namespace {

constexpr double kError_rad = 0.005 + 3.0 * 0.01 * std::numbers::sqrt2;

TEST(MountingHistory, TellsHowFarTheMountsHaveTurnedSinceALandmarkWasBuilt) {
  MountingHistory history;
  history.add_built(1, 10);  // before any panorama told the direction
  history.add(20, MountDirection{0.3, 1e-4});
  history.add_built(2, 20);
  EXPECT_EQ(history.turned_rad(1), 0.0);
  history.add(30, MountDirection{0.5, 1e-4});
  history.add_built(3, 30);
  history.add_built(4, 29);                                // finished after the turn
  for (const std::uint32_t earlier : {1U, 2U, 4U, 99U}) {  // 99: of an earlier journey
    EXPECT_NEAR(history.turned_rad(earlier), 0.2 - kError_rad, 1e-12) << earlier;
  }
  EXPECT_EQ(history.turned_rad(3), 0.0);
  history.add(40, MountDirection{0.3, 1e-4});
  EXPECT_NEAR(history.turned_rad(3), 0.2 - kError_rad, 1e-12);
  EXPECT_EQ(history.turned_rad(2), 0.0) << "it was turned back";
}

TEST(MountingHistory, TellsHowFarTheMountsHaveTurnedSinceTheJourneyBefore) {
  MountingHistory history;
  history.remember(MountDirection{0.1, 1e-4});
  EXPECT_EQ(history.turned_rad(1), 0.0) << "nothing is measured";
  history.add(20, MountDirection{0.3, 1e-4});
  history.add_built(2, 20);
  EXPECT_NEAR(history.turned_rad(1), 0.2 - kError_rad, 1e-12);
  EXPECT_EQ(history.turned_rad(2), 0.0);
}

TEST(MountingHistory, CountsNoErrorsOfTheDirections) {
  MountingHistory history;
  EXPECT_EQ(history.turned_rad(1), 0.0) << "nothing is known";
  history.add(1, MountDirection{0.0, 1e-4});
  history.add(2, MountDirection{0.9 * kError_rad, 1e-4});
  EXPECT_EQ(history.turned_rad(1), 0.0);
  history.add(3, std::nullopt);
  EXPECT_EQ(history.turned_rad(1), 0.0);
}

TEST(MountingHistory, DoesNotMixTheTimesOfTwoClocks) {
  MountingHistory history;
  history.add(100, MountDirection{0.0, 0.0});
  history.add(200, MountDirection{0.5, 0.0});
  history.forget_stamps();
  history.add_built(1, 150);  // when, is unknown: as if from the beginning
  EXPECT_NEAR(history.turned_rad(1), 0.5 - 0.005, 1e-12);
  history.add(10, MountDirection{0.5, 0.0});
  history.add_built(2, 15);
  EXPECT_EQ(history.turned_rad(2), 0.0);
}

TEST(MountingHistory, TurnsTheShorterWay) {
  MountingHistory history;
  history.add(1, MountDirection{std::numbers::pi - 0.1, 0.0});
  history.add(2, MountDirection{-std::numbers::pi + 0.1, 0.0});
  EXPECT_NEAR(history.turned_rad(1), 0.2 - 0.005, 1e-12);
}

}  // namespace
}  // namespace panvo::localizer
