// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "panvo/simulated_world/road_network.hpp"

namespace panvo::simulated_world {

/// Straight roads of equal width from the origin to these ends; junctions "middle", "end 0", "end 1", ...
inline RoadNetwork star_network(const std::vector<Eigen::Vector2d>& ends, double width_m) {
  RoadNetwork network;
  network.junctions.push_back({"middle", Eigen::Vector2d::Zero(), {}, true});
  for (const Eigen::Vector2d& end : ends) {
    const int road = static_cast<int>(network.roads.size());
    network.junctions.front().roads.push_back(road);
    network.junctions.push_back({"end " + std::to_string(road), end, {road}});
    Road& added = network.roads.emplace_back();
    added.from = 0;
    added.to = road + 1;
    added.width_m = width_m;
    const int steps = static_cast<int>(end.norm());
    for (int i = 0; i <= steps; ++i) added.centre_line.emplace_back(end * i / steps);
  }
  return network;
}

}  // namespace panvo::simulated_world
