// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "panvo/simulated_world/road_network.hpp"

namespace panvo::simulated_world {

/// The kerbs of a road network and the distance of any point from them.
///
/// The carriageway is the union of the roads' strips and the turning circles at dead ends, after morphological closing
/// with a disc of kCornerRadius_m. This rounds all corners of junctions to that radius and leaves straight kerbs
/// unchanged. Distances are stored on a grid.
class KerbField {
 public:
  static constexpr double kCornerRadius_m = 5.0;
  static constexpr double kTurningCircleRadius_m = 7.0;

  explicit KerbField(const RoadNetwork& roads);

  /// Signed distance (m): negative on the road.
  double distance_m(const Eigen::Vector2d& point) const;

  /// Unit vector of increasing distance: away from the road.
  Eigen::Vector2d outwards(const Eigen::Vector2d& point) const;

  /// As RoadNetwork::nearest_road, but for the road whose edge is nearest, and without a search over all roads: exact
  /// near roads, within centimetres far away.
  RoadNetwork::Nearest nearest_road(const Eigen::Vector2d& point) const;

  /// Length (m) of a road's centre line.
  double length_m(int road) const { return lengths_m_[static_cast<std::size_t>(road)]; }

  /// The kerbs as closed polylines (the last point connects to the first) with the road on their left and points at
  /// most half a metre apart.
  std::vector<std::vector<Eigen::Vector2d>> kerb_lines() const;

 private:
  struct Segment {
    Eigen::Vector2d start, along;  ///< unit direction
    double length_m, half_width_m, start_along_m;
    int road;

    double distance_to_middle_m(const Eigen::Vector2d& point) const;
    double distance_m(const Eigen::Vector2d& point) const { return distance_to_middle_m(point) - half_width_m; }
  };
  struct Crossing;

  void add_segments(const RoadNetwork& roads);
  void size_grid();
  void add_turning_circles(const RoadNetwork& roads);
  void round_corners();
  Eigen::Vector2d node(int column, int row) const;
  std::size_t index(int column, int row) const { return static_cast<std::size_t>(row) * columns_ + column; }
  std::vector<std::int32_t> nearest_segments(const std::vector<Segment>& segments, double reach_m) const;
  template <typename Visit>
  void march(const std::vector<float>& field, float level, const Visit& visit) const;

  Eigen::Vector2d corner_;  ///< of the grid
  int columns_ = 0, rows_ = 0;
  std::vector<Segment> segments_;
  std::vector<double> lengths_m_;
  std::vector<std::int32_t> nearest_;  ///< nearest segment of each node
  std::vector<float> distance_m_;      ///< of each node
};

}  // namespace panvo::simulated_world
