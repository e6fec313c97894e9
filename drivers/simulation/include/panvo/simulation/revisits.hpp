// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "panvo/simulated_world/road_network.hpp"
#include "panvo/simulation/vehicle_motion.hpp"

namespace panvo::simulation {

/// A pass through a crossing.
struct Visit {
  int junction = 0;
  double entered_s = 0.0, closest_s = 0.0, left_s = 0.0;  ///< within `radius_m` of the junction; closest approach
  double travelled_m = 0.0, closest_m = 0.0;              ///< at the closest approach
  double heading_entered_rad = 0.0, heading_closest_rad = 0.0, heading_left_rad = 0.0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< at the closest approach
};

/// A repeated visit to a place.
struct Revisit {
  int visit = 0, first_visit = 0;
  double entrance_angle_rad = 0.0;  ///< heading on entering now minus then, (-pi, pi] [Lu2015 Table 2]
  double offset_m = 0.0;            ///< between the two closest approaches
};

std::vector<Visit> find_visits(const simulated_world::RoadNetwork& roads, const VehicleMotion& motion,
                               double radius_m = 8.5);
std::vector<Revisit> find_revisits(const std::vector<Visit>& visits);

}  // namespace panvo::simulation
