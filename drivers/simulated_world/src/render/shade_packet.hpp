// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "embree.hpp"

namespace panvo::simulated_world {

struct SurfaceRecord;
struct ObjectRecord;

inline constexpr int kPacket = 16;           ///< rays traced and shaded together
inline constexpr int kMaxLevels = 16;        ///< of a texture's pyramid
inline constexpr int kEnvironmentSide = 64;  ///< entries along a side of the reflection map

/// A texture in the pool: sizes are powers of two.
struct TextureRecord {
  std::uint32_t log2_width = 0, log2_height = 0, last_level = 0, padding = 0;
  std::array<std::uint32_t, kMaxLevels> offsets{};  ///< of each level's first texel in the pool
};
static_assert(sizeof(TextureRecord) == 20 * sizeof(std::uint32_t));

/// A material in the layout used for shading, in words of four bytes.
struct MaterialRecord {
  std::array<float, 3> tint{1.0f, 1.0f, 1.0f};
  std::uint32_t albedo = 0;     ///< into the textures
  std::array<float, 3> mean{};  ///< of the albedo
  std::uint32_t overlay = 0;
  float periods_per_m = 1.0f, overlay_periods_per_m = 1.0f;
  float gloss = 0.0f, translucency = 0.0f;
  std::uint32_t flags = 0;
  float snow = 0.0f;
  float shine = 0.0f;  ///< radiance with the lamps on
  float wet = 0.0f;
};
static_assert(sizeof(MaterialRecord) == 16 * sizeof(std::uint32_t));
inline constexpr std::uint32_t kHasOverlay = 1, kOverlayIsScattered = 2, kTakesObjectTint = 4, kHasHoles = 8,
                               kIsWindow = 16;  ///< flags

/// A lamp in the layout used for shading.
struct LampRecord {
  float x = 0.0f, y = 0.0f, z = 0.0f, intensity = 0.0f;
  float sideways = 1.0f;  ///< fraction of the light that goes sideways
};
inline constexpr float kLampReach_m = 45.0f;  ///< beyond it a lamp adds less than the night sky

/// Inputs of shading, from scene and frame.
struct ShadingTables {
  const SurfaceRecord* surfaces = nullptr;
  const ObjectRecord* objects = nullptr;
  const MaterialRecord* materials = nullptr;
  const TextureRecord* textures = nullptr;
  const std::uint32_t* texels = nullptr;
  std::uint32_t first_moving_object = 0;
  const float* environment = nullptr;  ///< octahedral map: red, green, blue planes
  std::array<float, 3> to_sun{}, sun{}, sky{}, ground{}, haze{};
  float haze_per_m = 0.0f;
  bool has_snow = false;
  bool has_water = false;
  float film_limit = 0.0f;  ///< radiance above which shading spreads what a film of water mirrors, not its rays
  const LampRecord* lamps = nullptr;
  std::uint32_t lamp_count = 0;            ///< 0: the lamps are off
  std::uint32_t evening = 0;               ///< decides which rooms are lit
  std::array<float, 3> camera_motion{};    ///< while the shutter is open, m
  std::array<float, 9> camera_rotation{};  ///< change of a world direction in that time, row by row
  int texture_taps = 4;
};

/// Sixteen traced rays.
struct alignas(64) TracedPacket {
  RTCRayHit16 rays;
  std::int32_t is_moving[kPacket];  ///< -1: hit in the scene of the movers
  float across[3][kPacket];         ///< change of the direction per column, world frame
  float down[3][kPacket];           ///< change of the direction per row
  float motion_share = 1.0f;        ///< fraction of the shutter time that this sample covers
};

/// Copies a ray with its hit from one packet to another.
void copy_lane(const TracedPacket& from, std::size_t lane, TracedPacket& to, std::size_t to_lane);

/// Radiance along sixteen rays that hit something: base + (sun, unless in shadow). At night `sun` is the brightest lamp.
/// On wet ground, what is seen along the rays of `mirrored` comes on top.
struct alignas(64) ShadedPacket {
  float base[3][kPacket];
  float sun[3][kPacket];
  RTCRay16 shadow;
  std::int32_t wants_shadow[kPacket];  ///< -1: may be sunlit, trace a shadow ray
  std::uint32_t key[kPacket];          ///< object and material: differs across edges
  std::uint32_t normal[kPacket];       ///< x, y, z as signed bytes from the low end, then material flags
  float of_puddle[kPacket];            ///< reflectance, as of_film and mirrored set on wet campuses only
  float of_film[kPacket];              ///< reflectance for radiances up to ShadingTables::film_limit
  TracedPacket mirrored;               ///< origins, directions, times and changes from pixel to pixel of the rays
};

/// Shades the lanes that hit something; results of other lanes are undefined.
using ShadePacket = void (*)(const ShadingTables& tables, const TracedPacket& traced, ShadedPacket& shaded);

/// The fastest version that this processor supports.
ShadePacket max_shade_packet();

}  // namespace panvo::simulated_world
