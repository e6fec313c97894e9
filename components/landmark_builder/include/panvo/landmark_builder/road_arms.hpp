// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

namespace panvo::landmark_builder {

struct RoadArmsParameters {
  int directions = 120;
  double arm_length_m = 13.0;
  double widest_m = 13.0;
  double narrowest_m = 2.2;
  double min_gap_m = 2.0;
  double deepest_gap = 0.8;
  double search_radius_m = 7.0;
  double search_step_m = 1.0;
  double min_room_m = 2.2;
  double max_gap_m = 1.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = RoadArmsParameters;
    field(&P::directions, "directions", "1", "half-lines around a centre, over the full turn", 36, 720);
    field(&P::arm_length_m, "arm_length_m", "m", "minimum reach of an arm from the junction's centre", 3.0, 50.0);
    field(&P::widest_m, "widest_m", "m", "width of the widest arm at that distance; a wider one is a square", 2.0,
          50.0);
    field(&P::narrowest_m, "narrowest_m", "m", "width of the narrowest arm at that distance", 0.5, 20.0);
    field(&P::min_gap_m, "min_gap_m", "m", "smallest gap between two arms at that distance", 0.1, 20.0);
    field(&P::deepest_gap, "deepest_gap", "1", "largest reach of the road between two arms, fraction of arm_length_m",
          0.1, 1.0);
    field(&P::search_radius_m, "search_radius_m", "m", "search radius for a junction's centre around the vehicle", 0.0,
          30.0);
    field(&P::search_step_m, "search_step_m", "m", "spacing of the candidate centres", 0.1, 5.0);
    field(&P::min_room_m, "min_room_m", "m", "smallest distance of a junction's centre from the nearest kerb", 0.1,
          20.0);
    field(&P::max_gap_m, "max_gap_m", "m", "longest interruption that does not end a road", 0.0, 10.0);
  }
};

/// A road that leaves a junction.
struct RoadArm {
  double direction_rad = 0.0;  ///< counter-clockwise from the mask's "up", [0, 2 pi)
  double width_m = 0.0;        ///< at arm_length_m from the centre
  double reach_m = 0.0;        ///< largest reach, limited by the length of the half-lines
};

/// A candidate centre in the mask's pixels (column, row), and the roads that leave it.
struct RoadArms {
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  double room_m = 0.0;  ///< from the centre to the nearest kerb
  std::vector<RoadArm> arms;
  std::vector<float> reach_m;  ///< reach of each half-line around the centre
};

/// The Radon transform along half-lines: how far road reaches from a centre in each direction. Beyond the paper, whose
/// full lines cannot distinguish a T-junction from a bend, nor a crossing from its mirror image.
///
/// reach_m: for `directions` angles counter-clockwise from "up", up to `max_m`.
std::vector<float> ray_radon(const cv::Mat& mask, const Eigen::Vector2d& centre_px, double resolution_m, int directions,
                             double max_m, double max_gap_m);

/// Arms around one centre, from its field.
std::vector<RoadArm> find_arms(const std::vector<float>& reach_m, const RoadArmsParameters& parameters);

/// The best centre near `vehicle_px`: junctions (three or more arms) before all others, then by a weighted sum of the
/// number of arms and the room. `mask` is a passable region, 8UC1.
RoadArms find_best_centre(const cv::Mat& mask, const Eigen::Vector2d& vehicle_px, double resolution_m,
                          const RoadArmsParameters& parameters);

}  // namespace panvo::landmark_builder
