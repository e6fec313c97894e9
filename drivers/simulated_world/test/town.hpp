// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "panvo/simulated_world/site.hpp"

namespace panvo::simulated_world {

/// Two crossing roads, 120 m in each direction, one of them 8 m wide.
inline Site crossroads(std::uint64_t seed = 1, double hilliness = 0.0) {
  static const auto palette = std::make_shared<const Palette>(Palette::unpainted());
  RoadNetwork roads;
  roads.junctions = {{"west", {-120, 0}, {0}, false},
                     {"centre", {0, 0}, {1, 3, 0, 2}, true},
                     {"east", {120, 0}, {1}, false},
                     {"south", {0, -120}, {2}, false},
                     {"north", {0, 120}, {3}, false}};
  const auto road = [&](int from, int to, double width_m) {
    Road line{from, to, {}, width_m};
    const Eigen::Vector2d start = roads.junctions[static_cast<std::size_t>(from)].position;
    const Eigen::Vector2d end = roads.junctions[static_cast<std::size_t>(to)].position;
    for (int i = 0; i <= 120; ++i) line.centre_line.emplace_back(start + (end - start) * i / 120.0);
    roads.roads.push_back(line);
  };
  road(0, 1, 8.0);
  road(1, 2, 8.0);
  road(3, 1, 6.5);
  road(1, 4, 6.5);
  SiteParameters parameters;
  parameters.seed = seed;
  parameters.hilliness = hilliness;
  return Site(parameters, roads, palette);
}

}  // namespace panvo::simulated_world
