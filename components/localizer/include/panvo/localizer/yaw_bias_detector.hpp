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

  struct Bias {
    Stretch uncorrected;  ///< the whole stretch when its bias is noticed; then, while it lasts, only the newest turn
    double excess = 1.0;  ///< square of the whole stretch's disagreement over the variance that odometry states
  };

  /// `window_s`: time over which disagreements are summed; `sigmas`: threshold for their sum.
  YawBiasDetector(double window_s, double sigmas) : window_s_(window_s), sigmas_(sigmas) {}

  /// Adds a turn. A later turn against the same reference panorama replaces the earlier one, whose correction the caller
  /// undoes. Returns nullopt while there is no bias. A gap between turns restarts the sum.
  std::optional<Bias> add(const Stretch& turn);
  /// Restarts the sum.
  void forget() { *this = YawBiasDetector(window_s_, sigmas_); }

 private:
  void take(const Stretch& turn);

  double window_s_, sigmas_;
  std::deque<Stretch> turns_;
  bool is_biased_ = false;     // as of the last turn
  bool is_corrected_ = false;  // up to the reference of the last turn
};

}  // namespace panvo::localizer
