// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "panvo/simulated_world/palette.hpp"
#include "panvo/simulated_world/sky.hpp"
#include "shade_packet.hpp"

namespace panvo::simulated_world {

/// The palette as tables for shading sixteen rays at once.
class ShadingMaterials {
 public:
  /// Throws std::invalid_argument if a material has no texture, or if the palette has too many materials.
  explicit ShadingMaterials(const Palette& palette);

  void fill(ShadingTables& tables) const;
  const MaterialRecord& material(std::uint32_t number) const { return materials_[number]; }

  /// Whether a ray of width `width_m` at the material passes through a hole; `uv` in m.
  bool is_hole(std::uint32_t material, const Eigen::Vector2f& uv, float width_m) const;

 private:
  std::uint32_t add(const Texture& texture);

  std::vector<MaterialRecord> materials_;
  std::vector<TextureRecord> textures_;
  std::vector<std::uint32_t> texels_;  // of all textures and levels: red in the low byte
  bool has_snow_ = false, has_water_ = false;
};

/// The sky as reflected by glossy objects: a coarse octahedral map, recomputed when the light changes.
class Environment {
 public:
  explicit Environment(const Sky& sky) : sky_(&sky) {}
  const float* update(const Light& light);

 private:
  const Sky* sky_;
  Light light_;
  std::vector<float> map_;
};

}  // namespace panvo::simulated_world
