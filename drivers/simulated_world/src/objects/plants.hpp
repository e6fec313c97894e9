// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "panvo/simulated_world/mesh.hpp"
#include "panvo/simulated_world/palette.hpp"
#include "panvo/simulated_world/random.hpp"

namespace panvo::simulated_world {

/// The palette indices of plant materials, and the sizes of the leaf pictures.
struct PlantMaterials {
  explicit PlantMaterials(const Palette& palette);

  std::uint16_t bark, leaves_broad, leaves_small, leaves_needle, hedge, flowers, soil;
  float broad_period_m, small_period_m, needle_period_m;
};

enum class TreeKind { kBroad, kSpreading, kBirch, kPoplar, kYoung, kSpruce, kPine };

/// Builds a tree with its base at the origin, 5-14 m high depending on its kind.
Mesh build_tree(TreeKind kind, const PlantMaterials& materials, Random random);

/// Builds a shrub, `height_m` high and slightly wider.
Mesh build_shrub(const PlantMaterials& materials, float height_m, bool is_flowering, Random random);

/// Builds two metres of hedge along x, centred at the origin; its ends fit all hedges of the same height.
Mesh build_hedge(const PlantMaterials& materials, float height_m, float width_m, Random random);

/// Builds a flower bed of two metres along x.
Mesh build_flower_bed(const PlantMaterials& materials, Random random);

}  // namespace panvo::simulated_world
