// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "panvo/evaluation/journey_recording.hpp"
#include "panvo/panoramic_compass/panoramic_compass.hpp"

namespace panvo::evaluation {

/// Counts, and errors of the valid changes relative to the ground truth.
struct CompassScore {
  int changes = 0, valid = 0;
  double rms_deg = 0.0, p95_deg = 0.0, worst_deg = 0.0;
  double consistency = 0.0;  ///< mean of error^2 / variance; about 1 for a correct variance
  /// RMS error of the changes between consecutive panoramas: differences of two changes while the reference is kept.
  double step_rms_deg = 0.0;
  /// RMS error of the accumulated changes over 50 panoramas without a gap between them; nullopt if there are none. A new
  /// reference after failures leaves a gap: the turn up to it is not measured.
  std::optional<double> drift_rms_deg;
  std::int64_t worst_ns = 0;  ///< stamp of the largest error
};

/// Runs a compass over panoramas with their true poses, in order of time; `look` is called with each result and the true
/// change.
CompassScore score_compass(
    const Eigen::Matrix3d& base_from_panorama, const std::vector<RecordedPanorama>& panoramas,
    const panoramic_compass::CompassParameters& parameters,
    const std::function<void(const panoramic_compass::AzimuthChange&, double true_rad)>& look = {});

}  // namespace panvo::evaluation
