// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../plots.hpp"
#include "panvo/simulated_world/random.hpp"
#include "panvo/simulated_world/scene.hpp"
#include "panvo/simulated_world/site.hpp"

namespace panvo::simulated_world {

// The parts of which build_hall() builds the hall; each is in the source of its name.

inline constexpr float kHallHeight_m = 7.5f;

/// A rectangle along the world's axes, m.
struct HallArea {
  Eigen::Vector2f low = Eigen::Vector2f::Zero(), high = Eigen::Vector2f::Zero();
};

/// Floor, outer walls, pillars, roof and lamps; `plots` are free of pillars.
void build_hall_shell(const Site& site, const HallArea& area, const std::vector<PlannedPlot>& plots, Scene& scene);

/// What stands on a plot: shelves, an office, machines or stacks of pallets. `random`: of the plot.
Mesh build_hall_plot(const Site& site, const PlannedPlot& planned, const Random& random);

}  // namespace panvo::simulated_world
