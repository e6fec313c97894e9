// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

namespace panvo::localizer {

/// Whether the odometry leans: turns a little otherwise than the compass, again and again to the same side. Movers that fill half of the view
/// do that; each turn by itself is within its error, their sum is not.
class AzimuthLean {
 public:
  struct Stretch {
    std::int64_t from_ns = 0, to_ns = 0;
    double disagreement_rad = 0.0;  ///< compass minus odometry as it came
    double compass_rad = 0.0;       ///< turn by the compass
    double odometry_variance_rad2 = 0.0, compass_variance_rad2 = 0.0;
  };

  /// `window_s`: over how long disagreements are added up; `sigmas`: beyond which their sum is a lean.
  AzimuthLean(double window_s, double sigmas) : window_s_(window_s), sigmas_(sigmas) {}

  /// A turn; of several against the same panorama the last counts. The stretch over which odometry leans, as one; nullopt while it does
  /// not. Turns that do not follow upon each other begin anew.
  std::optional<Stretch> add(const Stretch& turn);
  /// What was so far is dealt with.
  void forget() { turns_.clear(); }

 private:
  double window_s_, sigmas_;
  std::deque<Stretch> turns_;
};

}  // namespace panvo::localizer
