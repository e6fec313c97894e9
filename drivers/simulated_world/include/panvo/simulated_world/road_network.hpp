// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace panvo::simulated_world {

/// A place where roads meet or a road ends.
struct Junction {
  std::string name;                                    ///< "gate", "library", ... : unique
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m, world frame
  std::vector<int> roads;                              ///< that start or end here, counter-clockwise from +x
  bool has_weak_texture = false;                       ///< plain asphalt and walls around it

  /// Whether three or more roads meet here. Bends and ends of cul-de-sacs do not count as places to recognise.
  bool is_crossing() const { return roads.size() >= 3; }
};

/// A road between two junctions, or a loop at one junction.
struct Road {
  int from = 0, to = 0;  ///< junctions
  std::vector<Eigen::Vector2d>
      centre_line;          ///< m; smooth, with a point about every metre, including both junctions' positions
  double width_m = 6.5;     ///< between the kerbs
  double max_step_m = 0.0;  ///< between neighbouring points of the centre line; 0: unknown, searches are slower
};

struct RoadNetwork {
  std::vector<Junction> junctions;
  std::vector<Road> roads;

  std::optional<int> find(std::string_view junction_name) const;
  /// Sets the junctions' roads, counter-clockwise from +x, from the roads' ends.
  void join();
  /// The road whose centre line is nearest to a point, the distance (m) to it and the position along it (m).
  struct Nearest {
    double distance_m = 0.0, along_m = 0.0;
    double side_m = 0.0;  ///< signed distance to the left of the centre line
    int road = 0;
  };
  Nearest nearest_road(const Eigen::Vector2d& point) const;
};

/// The campus roads: crossings, T and Y junctions, bends, a cul-de-sac and a loop without junction, about 450 m x 350 m
/// around the origin. The seed moves and bends everything by several metres. The plan and the connections of junctions
/// are fixed, so that a route given by junctions exists for every seed.
RoadNetwork campus_roads(std::uint64_t seed);

}  // namespace panvo::simulated_world
