// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <optional>

namespace panvo::localizer {

enum class SpeedVerdict { kAgrees, kContradicts, kUnclear };

/// What panoramas tell of an abrupt change of the odometry's speed: objects beside the path shift by as much per metre
/// as they did just before, as far as they stand equally far away.
class SpeedWitness {
 public:
  /// Adds a stretch on which odometry and panoramas agree. `at_m`: way of the whole journey at its end; `length_m`: by
  /// odometry; `parallax_rad`: see AzimuthMeasurement.
  void add(double at_m, double length_m, double parallax_rad);
  void forget() { stretches_.clear(); }

  /// Judges a stretch after the change, or across it. `said_m`: its length by odometry; `otherwise_m`: the length if the
  /// vehicle went on as before, if that is known.
  SpeedVerdict judge(double parallax_rad, double said_m, std::optional<double> otherwise_m) const;

  /// Of a stretch, by its parallax alone.
  struct Length {
    double m, error_m;  ///< the latter of the parallax, not of the scenery
  };
  /// Nullopt while too little is known.
  std::optional<Length> length(double parallax_rad) const;

 private:
  struct Stretch {
    double at_m, parallax_rad_per_m;
  };

  double usual_rad_per_m() const;

  std::deque<Stretch> stretches_;  // the last ones
};

}  // namespace panvo::localizer
