// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "panvo/simulation/texture.hpp"

namespace panvo::simulation {

/// What a surface is made of.
struct Material {
  std::string name;                        ///< "asphalt"
  std::shared_ptr<const Texture> albedo;   ///< tileable; its alpha cuts holes where `has_holes`
  float period_m = 1.0f;                   ///< of the albedo, along u and v
  std::shared_ptr<const Texture> overlay;  ///< tileable, multiplies the albedo by twice its value; may be null
  float overlay_period_m = 1.0f;           ///< of the overlay
  bool overlay_is_scattered = false;       ///< each period of the overlay is mirrored and turned by chance
  Eigen::Vector3f tint{1.0f, 1.0f, 1.0f};  ///< multiplies the albedo
  float gloss = 0.0f;                      ///< reflectance at normal incidence (glass 0.04-0.1); 0: matte
  float translucency = 0.0f;               ///< share of the sunlight that comes through from behind: leaves
  bool has_holes = false;                  ///< alpha < 0.5 is a hole
};

/// Every material of the campus. Textures are made from the seed; photographs of the folder `assets` (NAME.jpg or
/// NAME.png, tileable, over the material's period) take their places. Throws std::runtime_error naming the file that
/// cannot be read, or that is the name of no material.
class Palette {
 public:
  Palette(std::uint64_t seed, const std::filesystem::path& assets);

  const std::vector<Material>& materials() const { return materials_; }

  /// The number of the material of that name. Throws std::out_of_range naming it.
  std::uint16_t find(std::string_view name) const;

  /// All materials whose names begin with `prefix`, in order: the bricks, the plasters.
  std::vector<std::uint16_t> family(std::string_view prefix) const;

 private:
  std::vector<Material> materials_;
};

}  // namespace panvo::simulation
