// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

namespace panvo::localizer {

/// Detects a bias of the odometry: small turns that differ from the compass repeatedly in one direction, e.g. due to
/// moving objects that fill half of the view. Each turn is within its error, their sum is not.
class YawBiasDetector {
 public:
  struct Stretch {
    std::int64_t from_ns = 0, to_ns = 0;
    double disagreement_rad = 0.0;  ///< compass minus odometry as received
    double compass_rad = 0.0;       ///< turn by the compass
    double odometry_variance_rad2 = 0.0, compass_variance_rad2 = 0.0;
  };

  /// `window_s`: time over which disagreements are summed; `sigmas`: threshold for their sum.
  YawBiasDetector(double window_s, double sigmas) : window_s_(window_s), sigmas_(sigmas) {}

  /// Adds a turn; of several against one reference panorama the last counts. Returns the whole biased stretch; nullopt
  /// while there is no bias. Turns that are not consecutive restart the sum.
  std::optional<Stretch> add(const Stretch& turn);
  /// Restarts the sum.
  void forget() { turns_.clear(); }

 private:
  double window_s_, sigmas_;
  std::deque<Stretch> turns_;
};

}  // namespace panvo::localizer
