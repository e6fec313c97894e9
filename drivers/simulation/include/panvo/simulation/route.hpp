// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "panvo/simulated_world/road_network.hpp"

namespace panvo::simulation {

/// The vehicle's route from junction to junction.
struct Route {
  std::string name;                    ///< "short"
  std::vector<std::string> junctions;  ///< at least two; successive ones are joined by a road
  std::string description;             ///< one line, for users
};

/// How a vehicle turns at a junction.
enum class Steering {
  kCar,           ///< along an arc
  kDifferential,  ///< it stops, turns in place, and goes on
};

/// The path of a route: the right-hand lanes of its roads with drivable turns, one point about every 0.1 m.
struct DrivenPath {
  std::vector<Eigen::Vector2d> points;      ///< m, world frame
  std::vector<double> along_m;              ///< arc length of each point
  std::vector<double> curvature_per_m;      ///< signed, left positive
  std::vector<std::size_t> turns_in_place;  ///< points at which the vehicle stops and turns, ascending
};

/// The path of a route, `left_m` to the left of the lanes' middles. Throws std::invalid_argument for an unknown junction
/// (with the valid ones) or for two junctions without a road between them.
DrivenPath drive(const simulated_world::RoadNetwork& roads, const Route& route, double left_m = 0.0,
                 Steering steering = Steering::kCar);

/// A random route through `junctions` junctions that turns back only in a cul-de-sac.
Route random_route(const simulated_world::RoadNetwork& roads, int junctions, std::uint64_t seed);

/// Reads a route file (YAML: name, junctions, description). Throws std::runtime_error with file, line and key.
Route read_route(const std::filesystem::path& file);

}  // namespace panvo::simulation
