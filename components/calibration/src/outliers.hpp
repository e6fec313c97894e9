// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "panvo/calibration/rig_calibration.hpp"

namespace panvo::calibration {

/// Removes from `observations` all corners of a camera and view that are inconsistent with `rig`, and adds them to
/// `rejections`. Removes views without corners from the rig. Returns whether anything was removed.
bool reject_sightings(Observations& observations, Rig& rig, std::vector<Rejection>& rejections);

/// Removes single outlier corners and counts them by camera. Returns whether anything was removed.
bool reject_corners(Observations& observations, const Rig& rig, std::vector<std::size_t>& stray_corners);

}  // namespace panvo::calibration
