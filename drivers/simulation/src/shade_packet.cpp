// SPDX-License-Identifier: Apache-2.0
#include "shade_packet.hpp"

#include <array>
#include <cstdint>
#include <limits>

#include "panvo/simulation/scene.hpp"
#include "traced_scene.hpp"

#define PANVO_PACKET_ISA 0
#pragma GCC diagnostic ignored "-Wpsabi"

namespace panvo::simulation {
namespace baseline {
#include "packet_math.inl"
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

ShadePacket fastest_shade_packet() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd")) {
    return avx512::shade_packet;
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return avx2::shade_packet;
#endif
  return baseline::shade_packet;
}

}  // namespace panvo::simulation
