// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "panvo/simulated_world/site.hpp"
#include "panvo/simulation/route.hpp"

namespace panvo::simulation {

using simulated_world::campus_roads;

namespace {

std::string problem_of(const std::vector<std::string>& junctions) {
  try {
    drive(campus_roads(1), Route{"test", junctions, ""});
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "none";
}

TEST(DrivenPath, ProblemsNameTheJunctions) {
  EXPECT_NE(problem_of({"library", "moon"}).find("unknown junction moon; known: stadium, library"), std::string::npos);
  EXPECT_NE(problem_of({"library", "gate"}).find("no road joins library and gate"), std::string::npos);
  EXPECT_NE(problem_of({"library", "theatre", "library"}).find("turns back at theatre"), std::string::npos);
  EXPECT_NE(problem_of({"library"}).find("at least two"), std::string::npos);
}

TEST(DrivenPath, KeepsToTheRightHandLane) {
  const simulated_world::RoadNetwork roads = campus_roads(2);
  const DrivenPath path = drive(roads, {"test", {"clock_tower", "bookshop"}, ""});
  for (std::size_t i = 0; i < path.points.size(); i += 50) {
    const auto nearest = roads.nearest_road(path.points[i]);
    EXPECT_NEAR(nearest.side_m, -2.0, 0.1);  // the road runs in this direction and is 8 m wide
  }
  const DrivenPath left = drive(roads, {"test", {"clock_tower", "bookshop"}, ""}, 0.5);
  EXPECT_NEAR(roads.nearest_road(left.points[100]).side_m, -1.5, 0.1);
  const DrivenPath back = drive(roads, {"test", {"bookshop", "clock_tower"}, ""});
  EXPECT_NEAR(roads.nearest_road(back.points[300]).side_m, 2.0, 0.1);
}

TEST(DrivenPath, StaysOnTheRoadWithAVehiclesWidthAndTurnsNoTighterThanItCan) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const simulated_world::Site site({seed, 0.0, false}, campus_roads(seed), nullptr);
    for (std::uint64_t walk = 0; walk < 6; ++walk) {
      const Route route = random_route(site.roads, 25, walk);
      const DrivenPath path = drive(site.roads, route);
      double nearest_kerb = -1e9, max_curved = 0.0;
      std::size_t where = 0;
      for (std::size_t i = 0; i < path.points.size(); ++i) {
        const double off = site.distance_from_kerb(path.points[i]);
        if (off > nearest_kerb) where = i;
        nearest_kerb = std::max(nearest_kerb, off);
        max_curved = std::max(max_curved, std::abs(path.curvature_per_m[i]));
      }
      EXPECT_LT(nearest_kerb, -0.9) << "seed " << seed << " walk " << walk << " at " << path.points[where].transpose();
      EXPECT_LT(max_curved, 1.0 / 4.5) << "seed " << seed << " walk " << walk;
    }
  }
}

TEST(DrivenPath, IsEvenAndItsCurvatureIsContinuous) {
  const DrivenPath path = drive(campus_roads(1), {"test", {"hospital", "east_gate", "hospital", "museum"}, ""});
  const double step = path.along_m.back() / static_cast<double>(path.points.size() - 1);
  EXPECT_NEAR(step, 0.1, 0.001);
  double turned = 0.0;
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    ASSERT_NEAR((path.points[i] - path.points[i - 1]).norm(), step, 1e-4);
    ASSERT_NEAR(path.along_m[i] - path.along_m[i - 1], step, 1e-4);
    if (i > 4 && i + 4 < path.points.size()) {
      ASSERT_LT(std::abs(path.curvature_per_m[i] - path.curvature_per_m[i - 1]), 0.02) << i;
    }
    turned += path.curvature_per_m[i] * step;
  }
  // the integrated curvature must equal the path's change of direction
  const Eigen::Vector2d first = path.points[1] - path.points[0], last = path.points.back() - *(path.points.end() - 2);
  const double expected = std::atan2(first.x() * last.y() - first.y() * last.x(), first.dot(last));
  EXPECT_NEAR(std::remainder(turned - expected, 2.0 * M_PI), 0.0, 0.01);
}

TEST(DrivenPath, OfARobotThatTurnsInPlaceIsStraightBetweenItsTurns) {
  const simulated_world::Site site({1, 0.0, false}, campus_roads(1), nullptr);
  const Route route{"test", {"hospital", "east_gate", "hospital", "museum", "theatre"}, ""};
  const DrivenPath path = drive(site.roads, route, 0.0, Steering::kDifferential);
  const auto way = [&](std::size_t from) -> Eigen::Vector2d {
    return (path.points[from + 1] - path.points[from]).normalized();
  };
  // in the cul-de-sac of east_gate it turns to the left twice
  std::vector<double> turns_deg;
  for (const std::size_t i : path.turns_in_place) {
    const Eigen::Vector2d in = way(i - 1), out = way(i);
    turns_deg.push_back(std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out)) * 180.0 / M_PI);
  }
  ASSERT_EQ(turns_deg.size(), 3U);
  EXPECT_NEAR(turns_deg[0], 90.0, 3.0);
  EXPECT_NEAR(turns_deg[1], 90.0, 3.0);
  for (std::size_t i = 1; i + 1 < path.points.size(); ++i) {
    EXPECT_LT(site.distance_from_kerb(path.points[i]), -0.5) << path.points[i].transpose();
    EXPECT_NEAR((path.points[i] - path.points[i - 1]).norm(), 0.1, 0.005);
    if (std::ranges::binary_search(path.turns_in_place, i)) continue;
    EXPECT_GT(way(i).dot(way(i - 1)), std::cos(0.03)) << i;
  }
}

}  // namespace
}  // namespace panvo::simulation
