// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "panvo/simulation/mesh.hpp"
#include "panvo/simulation/palette.hpp"
#include "panvo/simulation/random.hpp"

namespace panvo::simulation {

/// The numbers of the materials that plants are made of, and the size of a picture of leaves.
struct PlantMaterials {
  explicit PlantMaterials(const Palette& palette);

  std::uint16_t bark, leaves_broad, leaves_small, leaves_needle, hedge, flowers, soil;
  float broad_period_m, small_period_m, needle_period_m;
};

enum class TreeKind { kBroad, kSpreading, kBirch, kPoplar, kYoung, kSpruce, kPine };

/// A tree with its foot at the origin, 5-14 m high according to its kind.
Mesh build_tree(TreeKind kind, const PlantMaterials& materials, Random random);

/// A shrub, `height_m` high and somewhat wider.
Mesh build_shrub(const PlantMaterials& materials, float height_m, bool is_flowering, Random random);

/// Two metres of hedge along x, about the origin; its ends fit any other of the same height.
Mesh build_hedge(const PlantMaterials& materials, float height_m, float width_m, Random random);

/// A flower bed of two metres along x.
Mesh build_flower_bed(const PlantMaterials& materials, Random random);

}  // namespace panvo::simulation
