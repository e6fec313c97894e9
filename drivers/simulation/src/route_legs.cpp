// SPDX-License-Identifier: Apache-2.0
#include "route_legs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

namespace panvo::simulation {

using Eigen::Vector2d;
using simulated_world::Road;
using simulated_world::RoadNetwork;

Vector2d Leg::at(double along) const {
  const auto [i, share] = place(along);
  return (1.0 - share) * lane[i] + share * lane[i + 1];
}

Vector2d Leg::way(double along) const {
  const auto [i, share] = place(along);
  const double inside = std::clamp(share, 0.0, 1.0);
  return ((1.0 - inside) * ways[i] + inside * ways[i + 1]).normalized();
}

std::pair<std::size_t, double> Leg::place(double along) const {
  const double at = along / length_m * static_cast<double>(lane.size() - 1);
  const double i = std::clamp(std::floor(at), 0.0, static_cast<double>(lane.size() - 2));
  return {static_cast<std::size_t>(i), at - i};
}

namespace {

Leg leg_of(const RoadNetwork& roads, int number, int from) {
  const Road& road = roads.roads[static_cast<std::size_t>(number)];
  Leg leg;
  leg.road = number;
  leg.from = from;
  leg.to = road.from == from ? road.to : road.from;
  leg.lane = road.centre_line;
  if (road.from != from) std::reverse(leg.lane.begin(), leg.lane.end());
  leg.offset_m = road.width_m / 4.0;
  const auto last = leg.lane.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    leg.ways.push_back((leg.lane[std::min(i + 1, last)] - leg.lane[i > 0 ? i - 1 : 0]).normalized());
    if (i > 0) leg.length_m += (leg.lane[i] - leg.lane[i - 1]).norm();
  }
  for (std::size_t i = 0; i <= last; ++i) leg.lane[i] -= leg.offset_m * left_of(leg.ways[i]);
  leg.end_m = leg.length_m;
  return leg;
}

std::string route_names(const RoadNetwork& roads) {
  std::string names;
  for (const simulated_world::Junction& junction : roads.junctions)
    names += (names.empty() ? "" : ", ") + junction.name;
  return names;
}

}  // namespace

std::vector<Leg> legs_of(const RoadNetwork& roads, const Route& route) {
  if (route.junctions.size() < 2) {
    throw std::invalid_argument(
        fmt::format("route {}: needs at least two junctions, has {}", route.name, route.junctions.size()));
  }
  std::vector<int> numbers;
  for (const std::string& name : route.junctions) {
    const auto number = roads.find(name);
    if (!number) {
      throw std::invalid_argument(
          fmt::format("route {}: unknown junction {}; known: {}", route.name, name, route_names(roads)));
    }
    numbers.push_back(*number);
  }
  std::vector<Leg> legs;
  for (std::size_t i = 0; i + 1 < numbers.size(); ++i) {
    const int from = numbers[i], to = numbers[i + 1];
    std::optional<int> joining;
    std::string neighbours;
    for (const int number : roads.junctions[static_cast<std::size_t>(from)].roads) {
      const Road& road = roads.roads[static_cast<std::size_t>(number)];
      const int other = road.from == from ? road.to : road.from;
      if (other == to && !joining) joining = number;
      neighbours += (neighbours.empty() ? "" : ", ") + roads.junctions[static_cast<std::size_t>(other)].name;
    }
    if (!joining) {
      throw std::invalid_argument(fmt::format("route {}: no road joins {} and {}; from {} roads lead to {}", route.name,
                                              route.junctions[i], route.junctions[i + 1], route.junctions[i],
                                              neighbours));
    }
    if (!legs.empty() && legs.back().road == *joining && from != to &&
        roads.junctions[static_cast<std::size_t>(from)].roads.size() > 1) {
      throw std::invalid_argument(
          fmt::format("route {}: turns back at {}, which is not a cul-de-sac; continue to another of {}", route.name,
                      route.junctions[i], neighbours));
    }
    legs.push_back(leg_of(roads, *joining, from));
  }
  return legs;
}

}  // namespace panvo::simulation
