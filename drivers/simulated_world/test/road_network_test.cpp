// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulated_world/road_network.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace panvo::simulated_world {
namespace {

// A T: west to east along the x axis, and one north from the middle.
RoadNetwork tee() {
  RoadNetwork network;
  network.junctions = {{"middle", {0.0, 0.0}, {}, false},
                       {"west", {-40.0, 0.0}, {}, false},
                       {"east", {40.0, 0.0}, {}, false},
                       {"north", {0.0, 40.0}, {}, false}};
  for (const int end : {3, 1, 2}) {
    Road road{end, 0, {}, 6.0, 0.0};
    for (int i = 0; i <= 40; ++i) {
      road.centre_line.emplace_back(network.junctions[static_cast<std::size_t>(end)].position * (1.0 - i / 40.0));
    }
    network.roads.push_back(road);
  }
  network.join();
  return network;
}

TEST(RoadNetwork, JoinsRoadsCounterClockwiseFromEast) {
  const RoadNetwork network = tee();
  EXPECT_EQ(network.junctions[0].roads, (std::vector<int>{2, 0, 1}));
  EXPECT_EQ(network.junctions[3].roads, (std::vector<int>{0}));
  EXPECT_TRUE(network.junctions[0].is_crossing());
  EXPECT_FALSE(network.junctions[1].is_crossing());
}

TEST(RoadNetwork, FindsJunctionsByName) {
  EXPECT_EQ(tee().find("north"), 3);
  EXPECT_EQ(tee().find("south"), std::nullopt);
}

TEST(RoadNetwork, KnowsTheNearestRoadAndItsSide) {
  const auto nearest = tee().nearest_road({10.25, -3.0});
  EXPECT_EQ(nearest.road, 2);
  EXPECT_NEAR(nearest.distance_m, 3.0, 1e-12);
  EXPECT_NEAR(nearest.along_m, 29.75, 1e-12);  // the road starts in the east
  EXPECT_NEAR(nearest.side_m, 3.0, 1e-12);     // so south is left of it
  EXPECT_NEAR(tee().nearest_road({10.25, 3.0}).side_m, -3.0, 1e-12);
}

TEST(RoadNetwork, LongStepsSkipNothing) {
  const RoadNetwork skipping = campus_roads(3);
  RoadNetwork walking = skipping;
  for (Road& road : walking.roads) road.max_step_m = 0.0;
  for (double x = -230.0; x < 230.0; x += 17.3) {
    for (double y = -180.0; y < 180.0; y += 13.7) {
      const auto expected = walking.nearest_road({x, y}), found = skipping.nearest_road({x, y});
      ASSERT_EQ(found.road, expected.road) << x << " " << y;
      ASSERT_NEAR(found.distance_m, expected.distance_m, 1e-12);
      ASSERT_NEAR(found.along_m, expected.along_m, 1e-9);
      ASSERT_NEAR(found.side_m, expected.side_m, 1e-12);
    }
  }
}

}  // namespace
}  // namespace panvo::simulated_world
