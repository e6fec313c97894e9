// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace panvo::simulation {

/// A rectangle on the ground.
struct Footprint {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double heading_rad = 0.0;
  double length_m = 0.0, width_m = 0.0;
};

/// Distance (m) between two rectangles; 0 where they overlap.
double distance(const Footprint& a, const Footprint& b);

}  // namespace panvo::simulation
