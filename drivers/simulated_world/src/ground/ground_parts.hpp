// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ground_drape.hpp"
#include "ground_zones.hpp"
#include "panvo/simulated_world/site.hpp"

namespace panvo::simulated_world {

/// Adds lines along the roads, stop and give-way lines, zebra crossings, arrows, speed limits and parking bays.
void lay_markings(const Site& site, const GroundZones& zones, Drape& drape);

/// Adds filled trenches and holes, sealed cracks and joints.
void lay_repairs(const Site& site, const GroundZones& zones, Drape& drape);

/// Adds manholes, gutter grates and small covers.
void lay_covers(const Site& site, const GroundZones& zones, Drape& drape);

/// Whether the ground has no details here because of weak texture.
inline bool is_bare(const Site& site, const Eigen::Vector2d& point) { return site.weakness(point) > 0.3; }

}  // namespace panvo::simulated_world
