// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "panvo/simulation/random.hpp"
#include "panvo/simulation/site.hpp"

namespace panvo::simulation {

/// Where the pavement and what edges it end: buildings and gardens begin beyond (m from the kerb).
inline constexpr double kPavementWidth_m = 2.6;

/// A place beside a road.
struct Roadside {
  int road = 0;
  double along_m = 0.0;                                 ///< from the road's beginning
  double to_junction_m = 0.0;                           ///< the nearer of its ends
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();     ///< of the road, m
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();     ///< unit
  Eigen::Vector2d outwards = Eigen::Vector2d::UnitY();  ///< unit, away from the road, to the side in question
  double kerb_m = 0.0;                                  ///< from the middle to the kerb

  /// The point at that distance from the kerb.
  Eigen::Vector2d at(double from_kerb_m) const { return middle + (kerb_m + from_kerb_m) * outwards; }
};

/// Length (m) of a road's centre line.
double length_of(const Road& road);

/// The place beside `road`, `along_m` from its beginning; to the left of it or to the right.
Roadside roadside(const RoadNetwork& roads, int road, double along_m, bool is_left);

/// Corners, and points every few metres between them, of a plot and inside it.
std::vector<Eigen::Vector2d> probes_of(const Plot& plot);

/// Whether the plots, the second grown by `margin_m`, have ground in common.
bool overlap(const Plot& first, const Plot& second, double margin_m);

/// What a plot is for.
enum class PlotUse { kHouse, kTown, kInstitute, kHall, kOpen };

struct PlannedPlot {
  Plot plot;  ///< x along the road, to the right as seen from it; y away from it
  PlotUse use = PlotUse::kTown;
  Roadside place;
};

/// Plots along all roads, none on a road or another plot.
std::vector<PlannedPlot> plan_plots(const Site& site);

}  // namespace panvo::simulation
