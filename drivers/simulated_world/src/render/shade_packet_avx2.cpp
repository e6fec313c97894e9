// SPDX-License-Identifier: Apache-2.0
#if defined(__x86_64__)
#include <immintrin.h>

#include <array>
#include <cstdint>
#include <limits>

#include "panvo/simulated_world/scene.hpp"
#include "shade_packet.hpp"
#include "traced_scene.hpp"

#define PANVO_PACKET_ISA 2
#pragma GCC diagnostic ignored "-Wpsabi"
#pragma GCC push_options
#pragma GCC target("avx2,fma,bmi,bmi2")
namespace panvo::simulated_world::avx2 {
#include "packet_math.inl"
//
#include "packet_textures.inl"
//
#include "packet_surfaces.inl"
//
#include "packet_water.inl"
//
#include "shade_packet.inl"
}  // namespace panvo::simulated_world::avx2
#pragma GCC pop_options
#endif
