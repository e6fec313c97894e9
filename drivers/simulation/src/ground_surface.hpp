// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ground_paint.hpp"
#include "ground_zones.hpp"
#include "panvo/simulation/mesh.hpp"

namespace panvo::simulation {

constexpr double kKerbHeight_m = 0.12;
constexpr double kKerbStoneWidth_m = 0.15;

/// The ground itself: carriageways at the terrain's height, and beyond the kerb, 0.12 m higher, pavements, grass and
/// fields. The step between the two is open: kerb stones cover it.
Mesh ground_surface(const Site& site, const GroundZones& zones, const GroundPaint& paint);

/// Kerb stones, one after the other along every kerb.
Mesh kerb_stones(const Site& site, const GroundPaint& paint);

}  // namespace panvo::simulation
