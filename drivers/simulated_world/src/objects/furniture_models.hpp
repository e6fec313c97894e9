// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/simulated_world/mesh.hpp"
#include "panvo/simulated_world/palette.hpp"
#include "panvo/simulated_world/random.hpp"

namespace panvo::simulated_world {

/// The palette indices of street furniture materials.
struct FurnitureMaterials {
  explicit FurnitureMaterials(const Palette& palette);

  std::uint16_t metal_post, metal_painted, lamp_head, sign_red, sign_blue, sign_white, bin_plastic, wood_fence,
      concrete, stone_rubble, brick_red, ledge, tyre, poster;
};

// All models stand at the origin; the side that faces the road faces -y, as a building's front does. Lengths in m.
Mesh build_lamp_post(const FurnitureMaterials& materials, float height, bool is_lantern);
enum class SignKind { kStop, kSquare, kPlace, kArrow };
Mesh build_sign(const FurnitureMaterials& materials, SignKind kind);
Mesh build_litter_bin(const FurnitureMaterials& materials);
Mesh build_wheelie_bin(const FurnitureMaterials& materials);
Mesh build_bench(const FurnitureMaterials& materials);
Mesh build_bollard(const FurnitureMaterials& materials);
Mesh build_hydrant(const FurnitureMaterials& materials);
Mesh build_cabinet(const FurnitureMaterials& materials);
Mesh build_bicycle_stand(const FurnitureMaterials& materials, Random random);
Mesh build_notice_board(const FurnitureMaterials& materials);
/// Builds two metres of fence along x, with a post at one end only.
enum class FenceKind { kSlats, kBars, kWall, kBrickWall };
Mesh build_fence(const FurnitureMaterials& materials, FenceKind kind, Random random);

}  // namespace panvo::simulated_world
