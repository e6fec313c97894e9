// SPDX-License-Identifier: Apache-2.0
// Parts of planning that ordinary campuses and those of twins share.
#pragma once

#include <optional>
#include <vector>

#include "plots.hpp"

namespace panvo::simulated_world {

inline constexpr double kGapBetweenPlots_m = 3.0;

/// What is to be placed beside a road.
struct Wish {
  PlotUse use = PlotUse::kTown;
  double width_m = 0.0, depth_m = 0.0, setback_m = 0.0;
};

/// A random one of that use.
Wish draw_wish(PlotUse use, Random& random);

/// The plot at that place; nullopt if it would lie on a road or too near to one of `others`.
std::optional<PlannedPlot> fitting_plot(const Site& site, const Wish& wish, const Roadside& place,
                                        const std::vector<PlannedPlot>& others);

/// Plans plots of which each one stands at both of two twin junctions, along the roads there.
std::vector<PlannedPlot> plan_twins(const Site& site);

}  // namespace panvo::simulated_world
