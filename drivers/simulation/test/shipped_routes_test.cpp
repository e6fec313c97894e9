// SPDX-License-Identifier: Apache-2.0
// The shipped routes have their documented properties for every seed.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>

#include "panvo/simulation/revisits.hpp"

namespace panvo::simulation {

using simulated_world::RoadNetwork;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kTolerance_deg = 15.0;  // of entrance angles, on seeds 1 to 20

struct Journey {
  RoadNetwork roads;
  VehicleMotion motion;
  std::vector<Visit> visits;
  std::vector<Revisit> revisits;
};

Journey journey(const std::string& name, std::uint64_t seed) {
  RoadNetwork roads = simulated_world::campus_roads(seed);
  const Route route = read_route(std::filesystem::path(PANVO_CONFIG) / "routes" / (name + ".yaml"));
  EXPECT_EQ(route.name, name);
  VehicleMotion motion(drive(roads, route), simulated_world::Terrain(seed, 0.0), {}, seed);
  std::vector<Visit> visits = find_visits(roads, motion);
  std::vector<Revisit> revisits = find_revisits(visits);
  return {std::move(roads), std::move(motion), std::move(visits), std::move(revisits)};
}

double off_deg(double angle_rad, double expected_deg) {
  return std::abs(std::remainder(angle_rad / kDegree - expected_deg, 360.0));
}

TEST(ShippedRoutes, DatasetIRevisitsFromAllSidesAsTable2) {
  const std::vector<double> table_2_deg{-8, -138, -50, 119, -107, -62, -168};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Journey drive = journey("dataset_i", seed);
    EXPECT_GT(drive.motion.travelled_m(drive.motion.duration_s()), 3000.0);
    std::size_t met = 0;
    for (const Revisit& revisit : drive.revisits) {
      if (met == table_2_deg.size() || off_deg(revisit.entrance_angle_rad, table_2_deg[met]) > kTolerance_deg) continue;
      ++met;
      const Visit &now = drive.visits[static_cast<std::size_t>(revisit.visit)],
                  &then = drive.visits[static_cast<std::size_t>(revisit.first_visit)];
      const double since = now.travelled_m - then.travelled_m;
      EXPECT_GT(since, 250.0) << "seed " << seed << " revisit " << met;
      EXPECT_LT(since, 1700.0) << "seed " << seed << " revisit " << met;
    }
    EXPECT_EQ(met, table_2_deg.size()) << "seed " << seed;
    EXPECT_LE(drive.revisits.size(), 2 * table_2_deg.size()) << "seed " << seed;
  }
}

TEST(ShippedRoutes, DatasetIIMeetsDatasetIsPlacesMostlyFromTheirFirstSide) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Journey first = journey("dataset_i", seed), second = journey("dataset_ii", seed);
    std::map<int, double> known_rad;
    for (const Visit& visit : first.visits) known_rad.try_emplace(visit.junction, visit.heading_entered_rad);
    int met = 0, alike = 0;
    const std::vector<double> others_deg{-53, 70, -102};
    std::size_t others = 0;
    for (const Visit& visit : second.visits) {
      const auto known = known_rad.find(visit.junction);
      ASSERT_NE(known, known_rad.end()) << "seed " << seed;
      ++met;
      const double angle = visit.heading_entered_rad - known->second;
      if (off_deg(angle, 0.0) <= kTolerance_deg) ++alike;
      if (others < others_deg.size() && off_deg(angle, others_deg[others]) <= kTolerance_deg) ++others;
    }
    EXPECT_GE(met, 14) << "seed " << seed;
    EXPECT_GE(alike, 9) << "seed " << seed;
    EXPECT_EQ(others, others_deg.size()) << "seed " << seed;
  }
}

TEST(ShippedRoutes, CornerTurnsSharplyWhereTextureCanBeWeak) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Journey drive = journey("corner", seed);
    EXPECT_LT(drive.motion.duration_s(), 60.0);
    bool sharp = false;
    for (const Visit& visit : drive.visits) {
      const double turn = visit.heading_left_rad - visit.heading_entered_rad;
      sharp |=
          drive.roads.junctions[static_cast<std::size_t>(visit.junction)].has_weak_texture && off_deg(turn, 0.0) > 80.0;
    }
    EXPECT_TRUE(sharp) << "seed " << seed;
  }
}

TEST(ShippedRoutes, ShortTakesLessThanAMinuteAndRevisitsOnceAgainstTheFirstHeading) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Journey drive = journey("short", seed);
    EXPECT_LT(drive.motion.duration_s(), 60.0) << "seed " << seed;
    EXPECT_GT(drive.motion.travelled_m(drive.motion.duration_s()), 200.0);
    ASSERT_EQ(drive.revisits.size(), 1U) << "seed " << seed;
    EXPECT_GT(std::abs(drive.revisits[0].entrance_angle_rad), 150.0 * kDegree) << "seed " << seed;
  }
}

}  // namespace
}  // namespace panvo::simulation
