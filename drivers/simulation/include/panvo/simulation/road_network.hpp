// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace panvo::simulation {

/// A place where roads meet, or a road ends.
struct Junction {
  std::string name;                                    ///< "gate", "library", ... : unique
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m, world frame
  std::vector<int> roads;                              ///< that begin or end here, counter-clockwise from +x
  bool has_weak_texture = false;                       ///< fresh, even asphalt and plain walls about it

  /// Roads meet here: three or more (a bend or the end of a cul-de-sac is no junction to recognise).
  bool is_crossing() const { return roads.size() >= 3; }
};

/// A road between two junctions (which may be one and the same: a loop).
struct Road {
  int from = 0, to = 0;  ///< junctions
  std::vector<Eigen::Vector2d>
      centre_line;              ///< m; smooth, a point about every metre, both junctions' positions included
  double width_m = 6.5;         ///< between the kerbs
  double longest_step_m = 0.0;  ///< between neighbouring points of the centre line; 0: unknown, searches take longer
};

struct RoadNetwork {
  std::vector<Junction> junctions;
  std::vector<Road> roads;

  std::optional<int> find(std::string_view junction_name) const;
  /// Fills in the junctions' roads, counter-clockwise from +x, from the roads' ends.
  void join();
  /// Distance (m) from `point` to the nearest road's centre line, and which road and how far along it (m).
  struct Nearest {
    double distance_m = 0.0, along_m = 0.0;
    double side_m = 0.0;  ///< signed distance to the left of the centre line
    int road = 0;
  };
  Nearest nearest_road(const Eigen::Vector2d& point) const;
};

/// The campus's roads: crossings, T and Y junctions, bends, a cul-de-sac and a loop without junction, about 450 m x
/// 350 m around the origin. The seed moves and bends everything by several metres; the plan, and with it which
/// junctions are joined, stays, so that a route named by its junctions exists on every seed.
RoadNetwork campus_roads(std::uint64_t seed);

}  // namespace panvo::simulation
