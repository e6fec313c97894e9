// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulated_world/site.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "../src/kerb_field.hpp"
#include "panvo/simulated_world/random.hpp"
#include "small_network.hpp"

namespace panvo::simulated_world {
namespace {

using Eigen::Vector2d;

constexpr double kWidth_m = 6.0;

Site crossing(SiteParameters parameters = {}) {
  return Site(parameters, star_network({{60, 0}, {0, 60}, {-60, 0}, {0, -60}}, kWidth_m), nullptr);
}

TEST(Site, MeasuresFromTheKerbsOfAStraightRoad) {
  const Site site = crossing();
  for (const double side_m : {-12.0, -4.0, -3.0, -2.0, 2.0, 3.0, 4.0, 12.0}) {
    EXPECT_NEAR(site.distance_from_kerb({30.0, side_m}), std::abs(side_m) - 0.5 * kWidth_m, 0.01) << side_m;
  }
}

TEST(Site, RoundsTheCornersOfACrossing) {
  const Site site = crossing();
  // an arc of 5 m that touches the kerbs y = 3 and x = 3
  const Vector2d centre(8.0, 8.0);
  for (const double degrees : {185.0, 200.0, 225.0, 250.0, 265.0}) {
    const double angle = degrees * M_PI / 180.0;
    const Vector2d way(std::cos(angle), std::sin(angle));
    EXPECT_NEAR(site.distance_from_kerb(centre + KerbField::kCornerRadius_m * way), 0.0, 0.03) << degrees;
    EXPECT_NEAR(site.distance_from_kerb(centre + (KerbField::kCornerRadius_m + 1.0) * way), -1.0, 0.03) << degrees;
    EXPECT_NEAR(site.distance_from_kerb(centre + (KerbField::kCornerRadius_m - 1.0) * way), 1.0, 0.03) << degrees;
  }
}

TEST(Site, LeavesTheKerbStraightOppositeATurning) {
  const Site site({}, star_network({{60, 0}, {0, 60}, {-60, 0}}, kWidth_m), nullptr);
  for (double x = -20.0; x <= 20.0; x += 1.0) EXPECT_NEAR(site.distance_from_kerb({x, -3.0}), 0.0, 0.01) << x;
}

TEST(Site, HasATurningCircleAtADeadEnd) {
  const Site site = crossing();
  for (const Vector2d& way : {Vector2d(1.0, 0.0), Vector2d(0.0, 1.0), Vector2d(0.0, -1.0)}) {
    EXPECT_NEAR(site.distance_from_kerb(Vector2d(60.0, 0.0) + KerbField::kTurningCircleRadius_m * way), 0.0, 0.05);
  }
}

TEST(Site, KeepsMeasuringFarFromTheRoads) {
  const Site site = crossing();
  EXPECT_NEAR(site.distance_from_kerb({0.0, 500.0}), 433.0, 10.0);
  EXPECT_GT(site.distance_from_kerb({0.0, 600.0}), site.distance_from_kerb({0.0, 500.0}));
}

TEST(Site, StandsAKerbHigherBesideTheRoad) {
  const Site site = crossing({.seed = 4, .hilliness = 1.0});
  const Vector2d on_road(30.0, 2.0), beside(30.0, 4.0);
  EXPECT_DOUBLE_EQ(site.ground_m(on_road), site.terrain.height_m(on_road));
  EXPECT_DOUBLE_EQ(site.ground_m(beside), site.terrain.height_m(beside) + 0.12);
}

TEST(Site, WeakensTextureOnlyWhereAndWhenAsked) {
  const Site plain = crossing(), weak = crossing({.weak_texture = true});
  EXPECT_EQ(plain.weakness({0.0, 0.0}), 0.0);
  EXPECT_EQ(weak.weakness({0.0, 0.0}), 1.0);
  EXPECT_EQ(weak.weakness({12.0, 0.0}), 1.0);
  EXPECT_GT(weak.weakness({26.0, 0.0}), weak.weakness({30.0, 0.0}));
  EXPECT_EQ(weak.weakness({50.0, 0.0}), 0.0);
}

TEST(Site, IsNoneWithoutRoads) { EXPECT_THROW(Site({}, RoadNetwork{}, nullptr), std::invalid_argument); }

TEST(KerbField, FindsTheNearestRoadAsTheNetworkDoes) {
  const RoadNetwork roads = campus_roads(3);
  const KerbField kerbs(roads);
  Random random(3, "kerb field test");
  int compared = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vector2d point{random.uniform(-230.0, 230.0), random.uniform(-180.0, 180.0)};
    const RoadNetwork::Nearest expected = roads.nearest_road(point), found = kerbs.nearest_road(point);
    const auto edge_m = [&](const RoadNetwork::Nearest& nearest) {
      return nearest.distance_m - 0.5 * roads.roads[static_cast<std::size_t>(nearest.road)].width_m;
    };
    const int end = roads.roads[static_cast<std::size_t>(found.road)].to;
    if (roads.junctions[static_cast<std::size_t>(end)].roads.size() == 1) continue;  // a turning circle is nearer
    EXPECT_LT(edge_m(found), edge_m(expected) + 0.05);
    if (expected.distance_m > 15.0 || found.road != expected.road) continue;
    EXPECT_NEAR(found.distance_m, expected.distance_m, 0.05);
    EXPECT_NEAR(found.along_m, expected.along_m, 0.05);
    EXPECT_NEAR(found.side_m, expected.side_m, 0.05);
    ++compared;
  }
  EXPECT_GT(compared, 500);
}

TEST(KerbField, RunsKerbsRoundEveryBlock) {
  const KerbField kerbs(star_network({{60, 0}, {0, 60}, {-60, 0}, {0, -60}}, kWidth_m));
  const auto lines = kerbs.kerb_lines();
  ASSERT_EQ(lines.size(), 1u);  // four arms, one outline
  double area = 0.0;
  for (std::size_t i = 0; i < lines[0].size(); ++i) {
    const Vector2d &a = lines[0][i], &b = lines[0][(i + 1) % lines[0].size()];
    EXPECT_NEAR(kerbs.distance_m(a), 0.0, 0.01);
    EXPECT_LT((b - a).norm(), 0.75);
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  EXPECT_GT(area, 0.0);  // the road lies on its left
}

}  // namespace
}  // namespace panvo::simulated_world
