// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "panvo/landmarks/map_replica.hpp"

namespace panvo::landmark_builder {

struct LandmarkRuleParameters {
  double max_spacing_m = 100.0;
  double first_m = 4.0;
  double wait_for_clock_s = 0.0;
  double nearby_m = 15.0;
  double known_m = 12.0;
  int appearances = 4;
  double trusted_m = 300.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = LandmarkRuleParameters;
    field(&P::max_spacing_m, "max_spacing_m", "m",
          "path without a landmark after which one is built anywhere; 0: only at junctions", 0.0, 10000.0);
    field(&P::first_m, "first_m", "m",
          "path after which the first landmark of a new map is built, to recognise a return to the start", 0.0,
          10000.0);
    field(&P::wait_for_clock_s, "wait_for_clock_s", "s",
          "longest wait of a new landmark until the localizer knows the offset of the panoramic camera's clock, as "
          "panoramas with wrong stamps make wrong points; it ends after max_spacing_m, too; 0: do not wait",
          0.0, 60.0);
    field(&P::nearby_m, "nearby_m", "m", "smallest distance of a new landmark from any other", 0.0, 1000.0);
    field(&P::known_m, "known_m", "m", "path before and after a recognised landmark without new landmarks", 0.0,
          1000.0);
    field(&P::appearances, "appearances", "1",
          "landmarks at one place, if those of earlier runs are not recognised today; 1: no others", 1, 20);
    field(&P::trusted_m, "trusted_m", "m", "path after a recognised landmark on which the position tells the place",
          0.0, 10000.0);
  }
};

/// Decides which places become landmarks: one per junction, one after a long path without any, and one at the start of
/// a new map, as journeys often end there. None near a known landmark, by position or by recognition [Lu2015 4.1], unless
/// the place was described in an earlier run and is not recognised although the position is certain: it looks different.
class LandmarkRule {
 public:
  explicit LandmarkRule(const LandmarkRuleParameters& parameters) : parameters_(parameters) {}

  /// Reports when the run begins: landmarks that are older are of earlier runs.
  void begin(std::int64_t stamp_ns) { begin_ns_ = stamp_ns; }
  /// Reports that a landmark was built here.
  void taken(double travelled_m) { last_m_ = travelled_m; }
  /// Reports that a landmark was recognised here.
  void recognised(double travelled_m);

  /// Whether a place in the map that the vehicle passed at `place_travelled_m` along its path becomes a landmark.
  bool takes(const landmarks::MapReplica& map, const Eigen::Vector2d& position, double place_travelled_m) const;
  /// Whether the path since the last landmark, built or recognised, or since the start of a new map is long enough for
  /// a landmark without a junction.
  bool is_due(const landmarks::MapReplica& map, double travelled_m) const;

 private:
  LandmarkRuleParameters parameters_;
  std::optional<std::int64_t> begin_ns_;
  double last_m_ = 0.0;
  std::optional<double> recognised_m_;
};

}  // namespace panvo::landmark_builder
