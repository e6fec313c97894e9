// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "panvo/simulated_world/random.hpp"
#include "panvo/simulated_world/site.hpp"

namespace panvo::simulated_world {

/// Width (m from the kerb) of the pavement including its edging: buildings and gardens start beyond it.
inline constexpr double kPavementWidth_m = 2.6;

/// A position beside a road.
struct Roadside {
  int road = 0;
  double along_m = 0.0;                                 ///< from the road's start
  double to_junction_m = 0.0;                           ///< distance to the nearer end
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();     ///< of the road, m
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();     ///< unit
  Eigen::Vector2d outwards = Eigen::Vector2d::UnitY();  ///< unit, away from the road, to the side in question
  double kerb_m = 0.0;                                  ///< from the middle to the kerb

  /// The point at that distance from the kerb.
  Eigen::Vector2d at(double from_kerb_m) const { return middle + (kerb_m + from_kerb_m) * outwards; }
};

/// Length (m) of a road's centre line.
double length_of(const Road& road);

/// The position on the left or right side of `road`, `along_m` from its start.
Roadside roadside(const RoadNetwork& roads, int road, double along_m, bool is_left);

/// Test points of a plot: its corners, and points every few metres on its edges and inside.
std::vector<Eigen::Vector2d> probes_of(const Plot& plot);

/// Whether the plots overlap, the second one enlarged by `margin_m`.
bool overlap(const Plot& first, const Plot& second, double margin_m);

/// The use of a plot.
enum class PlotUse { kHouse, kTown, kInstitute, kHall, kOpen };

struct PlannedPlot {
  Plot plot;  ///< x along the road, to the right as seen from it; y away from it
  PlotUse use = PlotUse::kTown;
  Roadside place;
  std::optional<std::uint64_t> design{};  ///< equal for twins; nullopt: its own
};

/// Plans plots along all roads, without overlap with roads or other plots.
std::vector<PlannedPlot> plan_plots(const Site& site);

}  // namespace panvo::simulated_world
