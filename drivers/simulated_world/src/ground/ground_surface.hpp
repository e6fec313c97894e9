// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ground_paint.hpp"
#include "ground_zones.hpp"
#include "panvo/simulated_world/mesh.hpp"

namespace panvo::simulated_world {

constexpr double kKerbHeight_m = 0.12;
constexpr double kKerbStoneWidth_m = 0.15;

/// Builds the ground: carriageways at the terrain's height and, 0.12 m higher beyond the kerb, pavements, grass and
/// fields. The step between them is left open for the kerb stones.
Mesh ground_surface(const Site& site, const GroundZones& zones, const GroundPaint& paint);

/// Builds the kerb stones along all kerbs.
Mesh kerb_stones(const Site& site, const GroundPaint& paint);

}  // namespace panvo::simulated_world
