// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ground_drape.hpp"
#include "ground_paint.hpp"
#include "ground_zones.hpp"
#include "panvo/simulated_world/mesh.hpp"
#include "panvo/simulated_world/site.hpp"

namespace panvo::simulated_world {

// The parts of which build_ground() builds the ground; each is in the source of its name.

constexpr double kKerbHeight_m = 0.12;
constexpr double kKerbStoneWidth_m = 0.15;

/// Builds the ground: carriageways at the terrain's height and, 0.12 m higher beyond the kerb, pavements, grass and
/// fields. The step between them is left open for the kerb stones.
Mesh ground_surface(const Site& site, const GroundZones& zones, const GroundPaint& paint);

/// Builds the kerb stones along all kerbs.
Mesh kerb_stones(const Site& site, const GroundPaint& paint);

/// Adds filled trenches and holes, sealed cracks and joints.
void lay_repairs(const Site& site, const GroundZones& zones, Drape& drape);

/// Adds lines along the roads, stop and give-way lines, zebra crossings, arrows, speed limits and parking bays.
void lay_markings(const Site& site, const GroundZones& zones, Drape& drape);

/// Adds manholes, gutter grates and small covers.
void lay_covers(const Site& site, const GroundZones& zones, Drape& drape);

/// Whether the ground has no details here because of weak texture.
inline bool is_bare(const Site& site, const Eigen::Vector2d& point) { return site.weakness(point) > 0.3; }

}  // namespace panvo::simulated_world
