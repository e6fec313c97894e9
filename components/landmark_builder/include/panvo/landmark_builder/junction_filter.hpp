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
  double longest_gap_m = 3.0;
  double farthest_pass_m = 9.0;
  double least_seen_m = 2.0;
  double least_share = 0.5;

  template <class Field>
  static void describe(Field&& field) {
    using P = JunctionFilterParameters;
    field(&P::merge_radius_m, "merge_radius_m", "m", "centres this close to each other are one junction", 1.0, 50.0);
    field(&P::passed_m, "passed_m", "m", "farther away again than the nearest place by this: the junction is passed",
          0.5, 50.0);
    field(&P::longest_gap_m, "longest_gap_m", "m", "path without it after which a junction that lies behind is over",
          0.0, 50.0);
    field(&P::farthest_pass_m, "farthest_pass_m", "m", "a junction passed farther away than this is not taken", 0.5,
          50.0);
    field(&P::least_seen_m, "least_seen_m", "m", "path along which a junction must have been seen", 0.0, 50.0);
    field(&P::least_share, "least_share", "1", "share of the panoramas along that path that must have shown it", 0.0,
          1.0);
  }
};

/// A junction that one panorama shows.
struct SeenJunction {
  Eigen::Vector2d centre_in_odom = Eigen::Vector2d::Zero();
  int roads = 3;
};

/// A junction, once it lies behind.
struct PassedJunction {
  Eigen::Vector2d centre_in_odom = Eigen::Vector2d::Zero();
  std::int64_t nearest_stamp_ns = 0;  ///< of the panorama nearest to its centre
  double nearest_m = 0.0;             ///< from the vehicle's base to the centre then
  int panoramas = 0;                  ///< that showed it
};

/// Makes one junction of the many panoramas that show it.
class JunctionFilter {
 public:
  explicit JunctionFilter(const JunctionFilterParameters& parameters) : parameters_(parameters) {}

  /// A panorama: where the vehicle was, and the centre of the junction that it shows, if any. Returns the junctions that are
  /// passed by now; stamps must increase.
  std::vector<PassedJunction> add(std::int64_t stamp_ns, const Eigen::Vector2d& position_in_odom,
                                  const std::optional<SeenJunction>& seen);

  /// Whether a junction is being seen that is not told of yet.
  bool is_pending() const;

 private:
  struct Place {
    std::int64_t stamp_ns;
    Eigen::Vector2d position;
    double travelled_m;
  };
  struct Candidate {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();  // of the centres seen, by the path driven
    double weight = 0.0;
    int seen = 0;
    double first_m = 0.0, last_m = 0.0;  // travelled, when it was seen
    bool is_passed = false;              // and has been told; kept while it is still being seen
    Eigen::Vector2d centre() const { return sum / weight; }
  };

  std::optional<PassedJunction> conclude(const Candidate& candidate) const;
  std::optional<Place> nearest(const Eigen::Vector2d& centre, double since_m) const;

  JunctionFilterParameters parameters_;
  std::deque<Place> path_;
  std::vector<Candidate> candidates_;
};

}  // namespace panvo::landmark_builder
