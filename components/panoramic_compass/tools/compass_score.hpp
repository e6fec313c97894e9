// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "compass_recording.hpp"
#include "panvo/panoramic_compass/panoramic_compass.hpp"

namespace panvo::panoramic_compass {

/// Errors of the valid changes against the truth, and how many there were.
struct CompassScore {
  int changes = 0, valid = 0;
  double rms_deg = 0.0, p95_deg = 0.0, worst_deg = 0.0;
  double consistency = 0.0;  ///< mean of error^2 / variance: about 1 where the variance is honest
  /// The same of the changes from each panorama to the next, made of two changes against one reference where it is kept.
  double step_rms_deg = 0.0;
  /// RMS of what the changes, one upon another, are wrong by over 50 panoramas.
  double drift_rms_deg = 0.0;
  std::int64_t worst_ns = 0;  ///< stamp of the worst
};

/// Runs a compass over a recording; `look` sees each result beside the true change.
CompassScore score(const CompassRecording& recording, const CompassParameters& parameters,
                   const std::function<void(const AzimuthChange&, double true_rad)>& look = {});

}  // namespace panvo::panoramic_compass
