// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace panvo::simulated_world {

/// Right-angled triangles that cover a square without gaps, with adaptive size.
struct GroundGrid {
  std::vector<Eigen::Vector2d> points;                  ///< m
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise
};

/// Halves two triangles (and neighbours as needed to avoid gaps) until `wants_finer(middle, max_edge_m)` is false
/// or the short edges are `finest_m` long. The square has edges of finest_m times 2^levels, is centred at `centre` and
/// rotated by `heading_rad`.
GroundGrid adaptive_grid(const Eigen::Vector2d& centre, double heading_rad, double finest_m, int levels,
                         const std::function<bool(const Eigen::Vector2d&, double)>& wants_finer);

}  // namespace panvo::simulated_world
