// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ground_drape.hpp"
#include "ground_zones.hpp"
#include "panvo/simulation/site.hpp"

namespace panvo::simulation {

/// Lines along the roads, stop and give-way lines, zebra crossings, arrows, speed limits, parking bays.
void lay_markings(const Site& site, const GroundZones& zones, Drape& drape);

/// Trenches and holes that were filled, sealed cracks and joints.
void lay_repairs(const Site& site, const GroundZones& zones, Drape& drape);

/// Manholes, gutter grates and small covers.
void lay_covers(const Site& site, const GroundZones& zones, Drape& drape);

/// Where weak texture leaves nothing laid on the ground.
inline bool is_bare(const Site& site, const Eigen::Vector2d& point) { return site.weakness(point) > 0.3; }

}  // namespace panvo::simulation
