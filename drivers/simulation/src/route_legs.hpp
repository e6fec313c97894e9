// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <utility>
#include <vector>

#include "panvo/simulation/route.hpp"

namespace panvo::simulation {

inline Eigen::Vector2d left_of(const Eigen::Vector2d& way) { return {-way.y(), way.x()}; }

/// One road of the route, in driving direction.
struct Leg {
  int road = 0, from = 0, to = 0;
  std::vector<Eigen::Vector2d> lane, ways;  // points of the lane and unit directions at them
  double length_m = 0.0;
  double offset_m = 0.0;  // right of the centre line
  double begin_m = 0.0, end_m = 0.0;

  // `along` may lie outside the lane, which is extended straight at both ends.
  Eigen::Vector2d at(double along) const;
  Eigen::Vector2d way(double along) const;

 private:
  std::pair<std::size_t, double> place(double along) const;
};

/// The roads of `route`, one leg each, in its right-hand lane. Throws std::invalid_argument as drive() does.
std::vector<Leg> legs_of(const simulated_world::RoadNetwork& roads, const Route& route);

}  // namespace panvo::simulation
