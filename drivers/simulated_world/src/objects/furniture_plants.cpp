// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "furniture_planner.hpp"

namespace panvo::simulated_world {
namespace {

/// Of the junctions.
std::pair<Eigen::Vector2d, Eigen::Vector2d> extent_of(const RoadNetwork& roads) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9), high = -low;
  for (const auto& junction : roads.junctions) {
    low = low.cwiseMin(junction.position);
    high = high.cwiseMax(junction.position);
  }
  return {low, high};
}

}  // namespace

void FurniturePlanner::plant_rows() {
  for (int road = 0; road < static_cast<int>(site_.roads.roads.size()); ++road) {
    const double length = length_of(site_.roads.roads[static_cast<std::size_t>(road)]);
    for (const bool is_left : {false, true}) {
      Random random = random_.part(3).part(static_cast<std::uint64_t>(2 * road + (is_left ? 1 : 0)));
      if (!random.chance(0.6)) continue;
      const std::vector<std::uint32_t> kind{pick(random, models_.street_trees)};
      const double from_kerb = random.chance(0.5) ? 0.85 : 4.2;
      const double spacing = random.uniform(7.5, 13.0);
      for (double along = 10.0; along < length - 8.0; along += spacing) {
        const Roadside place = roadside(site_.roads, road, along, is_left);
        if (random.chance(0.1)) continue;
        plant(kind, place.at(from_kerb), from_kerb - 0.2, from_kerb < 2.0 ? 0.8 : 1.1, random);
      }
    }
  }
}

void FurniturePlanner::plant_at_walls() {
  for (std::size_t number = 0; number < planned_.size(); ++number) {
    const PlannedPlot& planned = planned_[number];
    if (planned.use == PlotUse::kOpen) continue;
    Random random = random_.part(4).part(number);
    const Eigen::Vector2d half = 0.5 * planned.plot.size;
    for (double x = -half.x() + 1.0; x < half.x() - 0.5; x += random.uniform(1.3, 4.0)) {
      if (std::abs(x) < 2.0 || random.chance(0.35)) continue;
      const Eigen::Vector2d point = on(planned.plot, x, -half.y() - 0.95);
      if (random.chance(0.25)) {
        if (has_room(point, 0.5, 2.0))
          try_to_stand(pick(random, models_.flower_beds), point, planned.plot.heading_rad, 0.9, 2.0);
      } else {
        plant(models_.shrubs, point, 2.0, 0.6, random);
      }
    }
    for (const double side : {-1.0, 1.0}) {
      for (double y = -half.y() + 1.0; y < half.y(); y += random.uniform(1.5, 5.0)) {
        if (random.chance(0.5)) plant(models_.shrubs, on(planned.plot, side * (half.x() + 0.95), y), 2.6, 0.6, random);
      }
    }
    if (random.chance(0.2)) {
      const Eigen::Vector2d point = on(planned.plot, random.uniform(-0.3, 0.3) * half.x(), -half.y() - 1.4);
      try_to_stand(models_.bicycles, point, planned.plot.heading_rad, 1.3, 2.6);
    }
  }
}

void FurniturePlanner::scatter_trees() {
  const auto [low, high] = extent_of(site_.roads);
  Random random = random_.part(5);
  constexpr double kBelt_m = 75.0, kSpacing_m = 8.5;
  for (double x = low.x() - kBelt_m; x < high.x() + kBelt_m; x += kSpacing_m) {
    for (double y = low.y() - kBelt_m; y < high.y() + kBelt_m; y += kSpacing_m) {
      const Eigen::Vector2d point(x + random.uniform(-4.0, 4.0), y + random.uniform(-4.0, 4.0));
      const double from_kerb = site_.distance_from_kerb(point);
      // a belt of forest behind the outermost buildings, single trees inside
      const double density = from_kerb > 38.0 ? 0.8 : from_kerb > 6.0 ? 0.45 : 0.3;
      Random own = random.part(
          static_cast<std::uint64_t>(static_cast<std::int64_t>(x * 8.0) * 100003 + static_cast<std::int64_t>(y * 8.0)));
      if (!own.chance(density)) continue;
      const bool is_shrub = own.chance(0.3);
      plant(is_shrub ? models_.shrubs : models_.lawn_trees, point, is_shrub ? 3.3 : 4.2, is_shrub ? 0.9 : 2.3, own);
    }
  }
}

void FurniturePlanner::plant_horizon() {
  const auto [low, high] = extent_of(site_.roads);
  Random random = random_.part(7);
  constexpr double kBelt_m = 180.0, kSpacing_m = 8.0, kFromRoads_m = 70.0, kWood_m = 23.0;
  for (double x = low.x() - kBelt_m; x < high.x() + kBelt_m; x += kSpacing_m) {
    for (double y = low.y() - kBelt_m; y < high.y() + kBelt_m; y += kSpacing_m) {
      const Eigen::Vector2d point(x + random.uniform(-3.5, 3.5), y + random.uniform(-3.5, 3.5));
      const bool is_wood = std::sin(point.x() / kWood_m) + std::sin(point.y() / kWood_m) > -0.5;  // with gaps
      if (is_wood) plant(models_.lawn_trees, point, kFromRoads_m, 2.5, random);
    }
  }
}

}  // namespace panvo::simulated_world
