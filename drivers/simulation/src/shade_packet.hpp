// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <cstdint>

namespace panvo::simulation {

struct SurfaceRecord;
struct ObjectRecord;

inline constexpr int kPacket = 16;           ///< rays that are traced and shaded together
inline constexpr int kMostLevels = 16;       ///< of a texture's pyramid
inline constexpr int kEnvironmentSide = 64;  ///< entries along a side of the map of what things reflect

/// A texture in the pool: sizes are powers of two.
struct TextureRecord {
  std::uint32_t log2_width = 0, log2_height = 0, last_level = 0, padding = 0;
  std::array<std::uint32_t, kMostLevels> offsets{};  ///< of each level's first texel in the pool
};
static_assert(sizeof(TextureRecord) == 20 * sizeof(std::uint32_t));

/// A material as shading reads it, in words of four bytes.
struct MaterialRecord {
  std::array<float, 3> tint{1.0f, 1.0f, 1.0f};
  std::uint32_t albedo = 0;     ///< into the textures
  std::array<float, 3> mean{};  ///< of the albedo
  std::uint32_t overlay = 0;
  float periods_per_m = 1.0f, overlay_periods_per_m = 1.0f;
  float gloss = 0.0f, translucency = 0.0f;
  std::uint32_t flags = 0;
  std::array<std::uint32_t, 3> padding{};
};
static_assert(sizeof(MaterialRecord) == 16 * sizeof(std::uint32_t));
inline constexpr std::uint32_t kHasOverlay = 1, kOverlayIsScattered = 2, kTakesObjectTint = 4,
                               kHasHoles = 8;  ///< flags

/// What shading needs of the scene and of the frame.
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
  std::array<float, 3> camera_motion{};    ///< while the shutter is open, m
  std::array<float, 9> camera_rotation{};  ///< what a direction in the world gains meanwhile, row by row
  int texture_taps = 4;
};

/// Sixteen rays that were traced.
struct alignas(64) TracedPacket {
  RTCRayHit16 rays;
  std::int32_t is_moving[kPacket];  ///< -1: hit in the scene of the movers
  float across[3][kPacket];         ///< what the direction gains per column, world frame
  float down[3][kPacket];           ///< and per row
  float motion_share = 1.0f;        ///< of the shutter's time that this sample stands for
};

/// Copies a ray with what it met from one packet to another.
void copy_lane(const TracedPacket& from, std::size_t lane, TracedPacket& to, std::size_t to_lane);

/// What is seen along sixteen rays that hit something: base + (sun, where nothing shadows it).
struct alignas(64) ShadedPacket {
  float base[3][kPacket];
  float sun[3][kPacket];
  RTCRay16 shadow;
  std::int32_t wants_shadow[kPacket];  ///< -1: the sun may shine there
  std::uint32_t key[kPacket];          ///< object and material: neighbours that differ have an edge between them
  std::uint32_t normal[kPacket];       ///< x, y, z as signed bytes from the low end, then material flags
};

/// Shades the lanes that hit something; the others' results mean nothing.
using ShadePacket = void (*)(const ShadingTables& tables, const TracedPacket& traced, ShadedPacket& shaded);

/// The best that this processor can run.
ShadePacket fastest_shade_packet();

}  // namespace panvo::simulation
