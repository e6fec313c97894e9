// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace panvo::simulation {

/// Right-angled triangles that cover a square without gaps, finer where it is asked for.
struct GroundGrid {
  std::vector<Eigen::Vector2d> points;                  ///< m
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise
};

/// Halves two triangles (and what their neighbours need in order to fit) until `wants_finer(middle, longest_edge_m)` is
/// false or the short edges are `finest_m` long. The square has edges of finest_m times 2^levels about `centre`, turned
/// by `heading_rad`.
GroundGrid adaptive_grid(const Eigen::Vector2d& centre, double heading_rad, double finest_m, int levels,
                         const std::function<bool(const Eigen::Vector2d&, double)>& wants_finer);

}  // namespace panvo::simulation
