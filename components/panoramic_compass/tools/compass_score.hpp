// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "compass_recording.hpp"
#include "panvo/panoramic_compass/panoramic_compass.hpp"

namespace panvo::panoramic_compass {

/// Counts, and errors of the valid changes relative to the ground truth.
struct CompassScore {
  int changes = 0, valid = 0;
  double rms_deg = 0.0, p95_deg = 0.0, worst_deg = 0.0;
  double consistency = 0.0;  ///< mean of error^2 / variance; about 1 for a correct variance
  /// RMS error of the changes between consecutive panoramas: differences of two changes while the reference is kept.
  double step_rms_deg = 0.0;
  /// RMS error of the accumulated changes over 50 panoramas.
  double drift_rms_deg = 0.0;
  std::int64_t worst_ns = 0;  ///< stamp of the largest error
};

/// Runs a compass over a recording; `look` is called with each result and the true change.
CompassScore score(const CompassRecording& recording, const CompassParameters& parameters,
                   const std::function<void(const AzimuthChange&, double true_rad)>& look = {});

}  // namespace panvo::panoramic_compass
