// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "panvo/simulated_world/texture.hpp"

namespace panvo::simulated_world {

/// What the time of year does to the campus.
enum class Season {
  kSummer,
  kBare,  ///< broad-leaved trees and shrubs have twigs only
  kSnow,  ///< the same, and snow lies on what faces upwards; roads are cleared, not clean
};

/// The material of a surface.
struct Material {
  std::string name;                        ///< "asphalt"
  std::shared_ptr<const Texture> albedo;   ///< tileable; its alpha cuts holes where `has_holes`
  float period_m = 1.0f;                   ///< of the albedo, along u and v
  std::shared_ptr<const Texture> overlay;  ///< tileable, multiplies the albedo by twice its value; may be null
  float overlay_period_m = 1.0f;           ///< of the overlay
  bool overlay_is_scattered = false;       ///< each period of the overlay is mirrored and rotated randomly
  Eigen::Vector3f tint{1.0f, 1.0f, 1.0f};  ///< multiplies the albedo
  float gloss = 0.0f;                      ///< reflectance at normal incidence (glass 0.04-0.1); 0: matte
  float translucency = 0.0f;               ///< fraction of sunlight transmitted from behind: leaves
  bool has_holes = false;                  ///< alpha < 0.5 is a hole
  float snow = 0.0f;                       ///< 0..1: coverage by snow of what faces upwards
  float wet = 0.0f;                        ///< 0..1: coverage by water of what faces upwards
};

/// All materials of the campus. Textures are generated from the seed; photographs in the folder `assets` (NAME.jpg or
/// NAME.png, tileable, covering the material's period) replace them. `only`: the materials that a small scene needs; the
/// others are left as in unpainted(). Throws std::runtime_error with the file that cannot be read or has no material of
/// its name.
class Palette {
 public:
  Palette(std::uint64_t seed, const std::filesystem::path& assets, Season season = Season::kSummer, bool wet = false,
          const std::vector<std::string>& only = {});

  /// The same materials, all grey and without wear: made at once, for what needs their names only.
  static Palette unpainted();

  const std::vector<Material>& materials() const { return materials_; }

  /// The index of the material of that name. Throws std::out_of_range with the name if there is none.
  std::uint16_t find(std::string_view name) const;

  /// Indices of all materials whose names start with `prefix`, in order: the bricks, the plasters.
  std::vector<std::uint16_t> family(std::string_view prefix) const;

 private:
  Palette() = default;

  std::vector<Material> materials_;
};

}  // namespace panvo::simulated_world
