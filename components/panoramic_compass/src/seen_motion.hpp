// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "panvo/panoramic_compass/turn_fit.hpp"

/// What a fit of all points says about the vehicle's motion besides the turn.
namespace panvo::panoramic_compass {

/// Variance of the direction of motion, rad^2. What is wrong with the turn looks like motion aside: its effect on the
/// direction is inversely proportional to the parallax.
double motion_azimuth_variance(const TurnFit& fit, double turn_variance_rad2);

/// Parallax of the points beside the vehicle, rad, after removing the turn [Lu2015 6]. If only few are there, as in open
/// land, they may be far away or badly tracked: then at least half of what the nearer of all points moved, in any
/// direction. `pairs`: those that were fitted.
double side_parallax(const std::vector<BearingPair>& pairs, const TurnFit& fit);

}  // namespace panvo::panoramic_compass
