// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "panvo/calibration/rig_calibration.hpp"

namespace panvo::calibration {

/// Takes whole sightings out of `observations` that `rig` does not explain, and adds to `rejections`. A view that nobody sees any more leaves
/// the rig, too. False: nothing was taken out.
bool reject_sightings(Observations& observations, Rig& rig, std::vector<Rejection>& rejections);

/// The same of single corners, counted by camera.
bool reject_corners(Observations& observations, const Rig& rig, std::vector<std::size_t>& stray_corners);

}  // namespace panvo::calibration
