// SPDX-License-Identifier: Apache-2.0
#include "shade_packet.hpp"

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>

#include "panvo/simulated_world/scene.hpp"
#include "traced_scene.hpp"

#define PANVO_PACKET_ISA 0
#pragma GCC diagnostic ignored "-Wpsabi"

namespace panvo::simulated_world {
namespace baseline {
#include "packet_math.inl"
//
#include "packet_textures.inl"
//
#include "packet_surfaces.inl"
//
#include "packet_water.inl"
//
#include "shade_packet.inl"
}  // namespace baseline

#if defined(__x86_64__)
namespace avx512 {
void shade_packet(const ShadingTables& tables, const TracedPacket& traced, ShadedPacket& shaded);
}
namespace avx2 {
void shade_packet(const ShadingTables& tables, const TracedPacket& traced, ShadedPacket& shaded);
}
#endif

void copy_lane(const TracedPacket& from, std::size_t lane, TracedPacket& to, std::size_t to_lane) {
  // Embree's packets consist of arrays of sixteen words
  static_assert(sizeof(RTCRayHit16) % (kPacket * sizeof(std::uint32_t)) == 0);
  constexpr std::size_t kWords = sizeof(RTCRayHit16) / (kPacket * sizeof(std::uint32_t));
  const auto* source = reinterpret_cast<const unsigned char*>(&from.rays);
  auto* target = reinterpret_cast<unsigned char*>(&to.rays);
  for (std::size_t i = 0; i < kWords; ++i) {
    std::memcpy(target + (i * kPacket + to_lane) * 4, source + (i * kPacket + lane) * 4, 4);
  }
  to.is_moving[to_lane] = from.is_moving[lane];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    to.across[axis][to_lane] = from.across[axis][lane];
    to.down[axis][to_lane] = from.down[axis][lane];
  }
  to.motion_share = from.motion_share;
}

ShadePacket max_shade_packet() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd")) {
    return avx512::shade_packet;
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return avx2::shade_packet;
#endif
  return baseline::shade_packet;
}

}  // namespace panvo::simulated_world
