// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "panvo/fleet/shared_map.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::fleet {

struct JoinParameters {
  int min_sightings = 3;
  double min_apart_m = 5.0;
  double min_path_m = 3.0;
  double outweigh = 2.0;
  double gate_chi_square = 22.5;
  double position_sigma_m = 0.1;
  double rotation_sigma_deg = 0.5;
  double drift_ratio = 0.01;
  double drift_deg_per_m = 0.005;
  double max_tilt_deg = 15.0;
  double max_sigma_m = 3.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = JoinParameters;
    field(&P::min_sightings, "min_sightings", "1",
          "smallest number of sightings that agree with each other. One may be of a place that looks alike; a second "
          "one that agrees by chance needs the same mistake twice; the third decides",
          2, 64);
    field(&P::min_apart_m, "min_apart_m", "m",
          "smallest distance between two of the places seen: views of one place can be wrong together, and do not "
          "determine the heading between the maps well",
          0.0, 1000.0);
    field(&P::min_path_m, "min_path_m", "m",
          "smallest path between two of the sightings, unless both robots saw the other's places: neighbouring "
          "panoramas can be wrong together",
          0.0, 1000.0);
    field(&P::outweigh, "outweigh", "1",
          "how many times as many agreeing sightings as contradicting ones, which agree with each other, a join needs",
          1.0, 100.0);
    field(&P::gate_chi_square, "gate_chi_square", "1",
          "two sightings agree below this squared Mahalanobis distance: 99.9 % of 6 degrees of freedom", 1.0, 1000.0);
    field(&P::position_sigma_m, "position_sigma_m", "m",
          "error of a sighting's position that its covariance does not contain: metric points share errors", 0.0, 10.0);
    field(&P::rotation_sigma_deg, "rotation_sigma_deg", "deg", "the same of its rotation", 0.0, 45.0);
    field(&P::drift_ratio, "drift_ratio", "1",
          "smallest relative position error between two places of one map, per metre between them: their covariances "
          "do not say how their errors are correlated",
          0.0, 1.0);
    field(&P::drift_deg_per_m, "drift_deg_per_m", "deg/m", "the same of the rotation", 0.0, 10.0);
    field(&P::max_tilt_deg, "max_tilt_deg", "deg", "largest tilt between two maps, which both have z up", 0.0, 180.0);
    field(&P::max_sigma_m, "max_sigma_m", "m",
          "largest standard deviation of a sighting's position: a vaguer one would agree with any other", 0.1, 100.0);
  }
};

/// A sighting between the maps a and b, whichever of their robots made it.
struct CrossSighting {
  std::uint32_t place_a = 0, place_b = 0;
  Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();  ///< base at place_a from base at place_b
  vision::Matrix6d covariance = vision::Matrix6d::Identity();  ///< of a_from_b
  double travelled_m = 0.0;                                    ///< path of the observer
  bool by_a = true;                                            ///< the observer
};

/// Sightings between two maps in either direction, at most kMaxCliqueNodes: of each direction those with the latest
/// versions. Sightings of places that are not known yet are left out.
std::vector<CrossSighting> cross_sightings(const SharedMap& a, const SharedMap& b);

/// What the sightings say about the relation of two maps. A function of the sightings and the poses of the places
/// alone, so that all robots that know the same decide the same, and a decision is undone by what contradicts it.
struct MapJoin {
  bool is_joined = false;
  std::string reason;  ///< why not joined; empty if joined
  int sightings = 0, agreeing = 0, contradicting = 0;
  int seen_places = 0;                ///< different pairs of places among the agreeing sightings
  std::vector<CrossSighting> agreed;  ///< the largest set of sightings that agree with each other
};

/// Finds the largest set of sightings each pair of which is consistent: going from one sighting through map a to the
/// other, and through map b back, ends where it began, within the uncertainty of the sightings and of both maps between
/// their places (pairwise consistent measurement sets [Mangelson2018]). Joined if this set is large enough, seen
/// from and showing different places, and outweighs the largest consistent set among the other sightings.
MapJoin decide(const SharedMap& a, const SharedMap& b, const JoinParameters& parameters);

/// Pose of map b in map a.
struct MapTransform {
  Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Identity();  ///< as vision::pose_error, at the origin of b
};

/// The transform between joined maps that fits near a place of map a. Maps are not rigid: they drift. So sightings
/// count less the less certain their place is relative to `near_a`. nullopt if no sighting is given or a place is
/// unknown.
std::optional<MapTransform> fit(const SharedMap& a, const SharedMap& b, const std::vector<CrossSighting>& agreed,
                                std::uint32_t near_a, const JoinParameters& parameters);

/// Covariance of the pose of j relative to i, two places of one map, in the axes of i. The map gives only the
/// covariance of each: what one has more than the other, and at least the drift of the parameters over their distance.
vision::Matrix6d relative_covariance(const Eigen::Isometry3d& map_from_i, const vision::Matrix6d& covariance_i,
                                     const Eigen::Isometry3d& map_from_j, const vision::Matrix6d& covariance_j,
                                     const JoinParameters& parameters);

}  // namespace panvo::fleet
