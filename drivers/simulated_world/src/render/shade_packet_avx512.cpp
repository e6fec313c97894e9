// SPDX-License-Identifier: Apache-2.0
#if defined(__x86_64__)
#include <immintrin.h>

#include <array>
#include <cstdint>
#include <limits>

#include "panvo/simulated_world/scene.hpp"
#include "shade_packet.hpp"
#include "traced_scene.hpp"

#define PANVO_PACKET_ISA 512
#pragma GCC diagnostic ignored "-Wpsabi"
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx512f,avx512dq,avx512vl,avx512bw,avx512cd,avx2,fma,bmi,bmi2"))), \
                             apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512vl,avx512bw,avx512cd,avx2,fma,bmi,bmi2")
#endif
namespace panvo::simulated_world::avx512 {
#include "packet_math.inl"
//
#include "packet_textures.inl"
//
#include "packet_surfaces.inl"
//
#include "packet_water.inl"
//
#include "shade_packet.inl"
}  // namespace panvo::simulated_world::avx512
#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif
