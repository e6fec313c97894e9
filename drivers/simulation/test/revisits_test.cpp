// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/revisits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace panvo::simulation {

using simulated_world::RoadNetwork;

namespace {

constexpr double kPi = std::numbers::pi;

// Right-angled roads 60 m apart: three columns, two rows; both middle junctions are crossings.
RoadNetwork ladder() {
  RoadNetwork network;
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 3; ++column) {
      network.junctions.push_back(
          {std::string(1, static_cast<char>('a' + 3 * row + column)), {60.0 * column, 60.0 * row}, {}, false});
    }
  }
  for (const auto& [from, to] : {std::pair{0, 1}, {1, 2}, {3, 4}, {4, 5}, {0, 3}, {1, 4}, {2, 5}}) {
    simulated_world::Road road{from, to, {}, 6.0, 0.0};
    const Eigen::Vector2d a = network.junctions[static_cast<std::size_t>(from)].position;
    const Eigen::Vector2d b = network.junctions[static_cast<std::size_t>(to)].position;
    for (int i = 0; i <= 60; ++i) road.centre_line.emplace_back(a + (b - a) * (i / 60.0));
    network.roads.push_back(road);
  }
  network.join();
  return network;
}

VehicleMotion motion_on(const RoadNetwork& roads, const std::vector<std::string>& junctions) {
  return {drive(roads, {"test", junctions, ""}), simulated_world::Terrain(1, 0.0), {}, 1};
}

TEST(Visits, AreThePassesThroughCrossings) {
  const RoadNetwork roads = ladder();
  const VehicleMotion motion = motion_on(roads, {"a", "b", "c", "f", "e", "d"});
  const auto visits = find_visits(roads, motion);
  ASSERT_EQ(visits.size(), 2U);  // c and f are bends; the journey starts after a and ends before d
  EXPECT_EQ(visits[0].junction, 1);
  EXPECT_EQ(visits[1].junction, 4);
  const Visit& straight = visits[0];
  EXPECT_NEAR(straight.closest_m, 1.5, 0.01);
  EXPECT_NEAR(straight.position.x(), 60.0, 0.01);
  EXPECT_NEAR(straight.travelled_m, 48.0, 0.05);  // it starts 12 m after a
  for (const double heading : {straight.heading_entered_rad, straight.heading_closest_rad, straight.heading_left_rad}) {
    EXPECT_NEAR(heading, 0.0, 1e-3);
  }
  for (const double t : {straight.entered_s, straight.left_s}) {
    EXPECT_NEAR((motion.world_from_base(t).translation().head<2>() - roads.junctions[1].position).norm(), 8.5, 1e-4);
  }
  EXPECT_LT(straight.entered_s, straight.closest_s);
  EXPECT_LT(straight.closest_s, straight.left_s);
}

TEST(Visits, KnowHeadingsOnBothSidesOfATurn) {
  const RoadNetwork roads = ladder();
  const auto visits = find_visits(roads, motion_on(roads, {"a", "b", "e", "f"}));
  ASSERT_EQ(visits.size(), 2U);
  EXPECT_NEAR(visits[0].heading_entered_rad, 0.0, 0.12);
  EXPECT_NEAR(visits[0].heading_closest_rad, kPi / 4.0, 0.1);
  EXPECT_NEAR(visits[0].heading_left_rad, kPi / 2.0, 0.12);
}

TEST(Visits, WhereTheJourneyBeginsOrEndsAreNone) {
  const RoadNetwork roads = ladder();
  EXPECT_TRUE(find_visits(roads, motion_on(roads, {"b", "e"}), 15.0).empty());
}

TEST(Revisits, CompareWithTheFirstVisit) {
  const RoadNetwork roads = ladder();
  // through b eastwards, then round the block anticlockwise and through b southwards, then again eastwards
  const auto visits = find_visits(roads, motion_on(roads, {"a", "b", "c", "f", "e", "b", "a", "d", "e", "b", "c"}));
  const auto revisits = find_revisits(visits);
  std::vector<int> junctions;
  for (const Visit& visit : visits) junctions.push_back(visit.junction);
  ASSERT_EQ(junctions, (std::vector<int>{1, 4, 1, 4, 1}));
  ASSERT_EQ(revisits.size(), 3U);
  EXPECT_EQ(revisits[0].visit, 2);
  EXPECT_EQ(revisits[0].first_visit, 0);
  EXPECT_NEAR(revisits[0].entrance_angle_rad, -kPi / 2.0, 0.15);     // now southwards, then eastwards
  EXPECT_NEAR(std::abs(revisits[1].entrance_angle_rad), kPi, 0.15);  // e: now eastwards, then westwards
  EXPECT_EQ(revisits[2].first_visit, 0);                             // not 1
  EXPECT_NEAR(revisits[2].offset_m, (visits[4].position - visits[0].position).norm(), 1e-12);
}

TEST(Revisits, EntranceAnglesLieInOneTurn) {
  std::vector<Visit> visits(3);
  visits[0].heading_entered_rad = -3.0;
  visits[1].heading_entered_rad = 3.0;
  visits[2].heading_entered_rad = kPi - 3.0;
  const auto revisits = find_revisits(visits);
  EXPECT_NEAR(revisits[0].entrance_angle_rad, 6.0 - 2.0 * kPi, 1e-12);
  EXPECT_NEAR(revisits[1].entrance_angle_rad, kPi, 1e-12);
}

}  // namespace
}  // namespace panvo::simulation
