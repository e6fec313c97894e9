// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "panvo/simulation/palette.hpp"
#include "panvo/simulation/sky.hpp"
#include "shade_packet.hpp"

namespace panvo::simulation {

/// The palette as tables that sixteen rays can look up at once.
class ShadingMaterials {
 public:
  /// Throws std::invalid_argument where a material has no texture, or the palette more materials than there are numbers.
  explicit ShadingMaterials(const Palette& palette);

  void fill(ShadingTables& tables) const;
  const MaterialRecord& material(std::uint32_t number) const { return materials_[number]; }

  /// Whether a ray that is `width_m` wide where it meets the material goes through a hole; `uv` in m.
  bool is_hole(std::uint32_t material, const Eigen::Vector2f& uv, float width_m) const;

 private:
  std::uint32_t add(const Texture& texture);

  std::vector<MaterialRecord> materials_;
  std::vector<TextureRecord> textures_;
  std::vector<std::uint32_t> texels_;  // of all textures and levels: red in the low byte
};

/// What shiny things mirror of the sky: a coarse octahedral map, made anew when the light changes.
class Environment {
 public:
  explicit Environment(const Sky& sky) : sky_(&sky) {}
  const float* update(const Light& light);

 private:
  const Sky* sky_;
  Light light_;
  std::vector<float> map_;
};

}  // namespace panvo::simulation
