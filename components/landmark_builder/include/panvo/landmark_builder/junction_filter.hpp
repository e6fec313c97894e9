// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace panvo::landmark_builder {

struct JunctionFilterParameters {
  double merge_radius_m = 20.0;
  double passed_m = 5.0;
  double max_gap_m = 3.0;
  double max_pass_distance_m = 9.0;
  double min_seen_m = 2.0;
  double min_share = 0.5;

  template <class Field>
  static void describe(Field&& field) {
    using P = JunctionFilterParameters;
    field(&P::merge_radius_m, "merge_radius_m", "m", "centres closer to each other are one junction", 1.0, 50.0);
    field(&P::passed_m, "passed_m", "m", "a junction is passed when this much farther away than at its nearest", 0.5,
          50.0);
    field(&P::max_gap_m, "max_gap_m", "m", "path without a detection after which a passed junction is complete", 0.0,
          50.0);
    field(&P::max_pass_distance_m, "max_pass_distance_m", "m", "junctions passed at a larger distance are discarded",
          0.5, 50.0);
    field(&P::min_seen_m, "min_seen_m", "m", "minimum path along which a junction is detected", 0.0, 50.0);
    field(&P::min_share, "min_share", "1", "minimum fraction of the panoramas along that path that show it", 0.0, 1.0);
  }
};

/// A junction detected in one panorama.
struct SeenJunction {
  Eigen::Vector2d centre_in_odom = Eigen::Vector2d::Zero();
  int roads = 3;
};

/// A junction that the vehicle has passed.
struct PassedJunction {
  Eigen::Vector2d centre_in_odom = Eigen::Vector2d::Zero();
  std::int64_t nearest_stamp_ns = 0;  ///< of the panorama nearest to its centre
  double nearest_m = 0.0;             ///< from the vehicle's base to the centre at that stamp
  int panoramas = 0;                  ///< number of panoramas that showed it
};

/// Merges the detections of one junction in successive panoramas.
class JunctionFilter {
 public:
  explicit JunctionFilter(const JunctionFilterParameters& parameters) : parameters_(parameters) {}

  /// Adds a panorama: the vehicle's position and the detected junction, if any. Returns the junctions that are now
  /// passed; stamps must increase.
  std::vector<PassedJunction> add(std::int64_t stamp_ns, const Eigen::Vector2d& position_in_odom,
                                  const std::optional<SeenJunction>& seen);

  /// Whether a detected junction has not been returned yet.
  bool is_pending() const;

 private:
  struct Place {
    std::int64_t stamp_ns;
    Eigen::Vector2d position;
    double travelled_m;
  };
  struct Candidate {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();  // of the detected centres, weighted by the path driven
    double weight = 0.0;
    int seen = 0;
    double first_m = 0.0, last_m = 0.0;  // path length at the first and last detection
    bool is_passed = false;              // and was returned; kept while still detected
    Eigen::Vector2d centre() const { return sum / weight; }
  };

  std::optional<PassedJunction> conclude(const Candidate& candidate) const;
  /// The place of the current visit nearest to a junction's centre. Precondition: the path is not empty.
  const Place& nearest(const Eigen::Vector2d& centre) const;

  JunctionFilterParameters parameters_;
  std::deque<Place> path_;
  std::vector<Candidate> candidates_;
};

}  // namespace panvo::landmark_builder
