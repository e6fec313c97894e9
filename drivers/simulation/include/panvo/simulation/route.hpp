// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "panvo/simulation/road_network.hpp"

namespace panvo::simulation {

/// Where the vehicle drives: from junction to junction by the roads that join them.
struct Route {
  std::string name;                    ///< "short"
  std::vector<std::string> junctions;  ///< at least two, neighbours joined by a road
  std::string description;             ///< one line, for people
};

/// The path of a route: the right-hand lane of its roads, with turns rounded as a vehicle drives them, as points at
/// about every 0.1 m.
struct DrivenPath {
  std::vector<Eigen::Vector2d> points;  ///< m, world frame
  std::vector<double> along_m;          ///< arc length of each point
  std::vector<double> curvature_per_m;  ///< signed, left positive
};

/// Throws std::invalid_argument naming the junction that there is not (and those there are), or the two that no road
/// joins.
DrivenPath drive(const RoadNetwork& roads, const Route& route);

/// A walk through `junctions` junctions drawn from a seed, turning back only in a cul-de-sac.
Route random_route(const RoadNetwork& roads, int junctions, std::uint64_t seed);

/// Reads a route file (YAML: name, junctions, description). Throws std::runtime_error naming file, line and key.
Route read_route(const std::filesystem::path& file);

}  // namespace panvo::simulation
