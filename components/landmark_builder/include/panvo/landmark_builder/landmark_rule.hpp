// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>

namespace panvo::landmark_builder {

struct LandmarkRuleParameters {
  double longest_without_m = 100.0;
  double first_m = 4.0;
  double nearby_m = 15.0;
  double known_m = 12.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = LandmarkRuleParameters;
    field(&P::longest_without_m, "longest_without_m", "m",
          "path without a landmark after which one is taken wherever the vehicle is; 0: only at junctions", 0.0,
          10000.0);
    field(&P::first_m, "first_m", "m",
          "path after which a new map's first landmark is taken, so that the way back to the start is recognised", 0.0,
          10000.0);
    field(&P::nearby_m, "nearby_m", "m", "no new landmark this close to another", 0.0, 1000.0);
    field(&P::known_m, "known_m", "m", "path before and after a recognised landmark along which no new one is taken",
          0.0, 1000.0);
  }
};

/// Which places become landmarks: one at each junction, and one where there has been none for long; none where a landmark is already, by
/// position or because it was recognised [Lu2015 4.1]. And where a new map begins, for journeys end where they began.
class LandmarkRule {
 public:
  explicit LandmarkRule(const LandmarkRuleParameters& parameters) : parameters_(parameters) {}

  /// A landmark there is, new or from an earlier journey, or that was moved.
  void set_landmark(std::uint32_t id, const Eigen::Vector2d& position);
  /// A landmark was taken here.
  void taken(double travelled_m) { last_m_ = travelled_m; }
  /// A landmark was recognised here.
  void recognised(double travelled_m);

  /// Whether a place becomes a landmark that the vehicle passed at `place_travelled_m` along its path.
  bool takes(const Eigen::Vector2d& position, double place_travelled_m) const;
  /// Whether the path since the last landmark, taken or recognised, or since a new map began, is long enough for one without a junction.
  bool is_due(double travelled_m) const;

  std::uint32_t next_id() const { return positions_.empty() ? 1 : positions_.rbegin()->first + 1; }
  bool has(std::uint32_t id) const { return positions_.contains(id); }

 private:
  LandmarkRuleParameters parameters_;
  std::map<std::uint32_t, Eigen::Vector2d> positions_;
  double last_m_ = 0.0;
  std::optional<double> recognised_m_;
};

}  // namespace panvo::landmark_builder
