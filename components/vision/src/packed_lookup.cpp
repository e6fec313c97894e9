// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/packed_lookup.hpp"

#include <stdexcept>
#include <string>

#include "packed_lookup_kernels.hpp"

namespace panvo::vision {
namespace {

#if !defined(__aarch64__)
constexpr LookupKernels kGreyPlain{look_up_plain<1>, blend_plain<1>};
constexpr LookupKernels kColourPlain{look_up_plain<3>, blend_plain<3>};
#endif

/// Kernels for this processor.
const LookupKernels& kernels(int channels) {
  if (channels != 1 && channels != 3)
    throw std::invalid_argument("look-up of " + std::to_string(channels) + " channels is not supported; use 1 or 3");
#if defined(__aarch64__)  // every such processor has NEON
  return channels == 1 ? kGreyLookupNeon : kColourLookupNeon;
#else
#if defined(__x86_64__)
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  if (has_avx2) return channels == 1 ? kGreyLookupAvx2 : kColourLookupAvx2;
#endif
  return channels == 1 ? kGreyPlain : kColourPlain;
#endif
}

}  // namespace

void prefetch_lookups(const LookupSource& source, const std::uint32_t* lookups, int count, int channels) {
  constexpr int kStride = 2;  // neighbouring look-ups mostly share a cache line
  const std::ptrdiff_t step = std::ptrdiff_t{source.row_px} * channels;
  for (int i = 0; i < count; i += kStride) {
    const std::uint8_t* upper = source.begin + std::ptrdiff_t{lookups[i] >> 10} * channels;
    __builtin_prefetch(upper);
    __builtin_prefetch(upper + step);
  }
}

void look_up(const LookupSource& source, const std::uint32_t* lookups, int count, int channels,
             std::uint8_t* destination) {
  kernels(channels).one(source, lookups, count, destination);
}

void look_up_blended(const LookupSource& first, const std::uint32_t* first_lookups, const LookupSource& second,
                     const std::uint32_t* second_lookups, const std::uint8_t* weights, int count, int channels,
                     std::uint8_t* destination) {
  kernels(channels).blended(first, first_lookups, second, second_lookups, weights, count, destination);
}

}  // namespace panvo::vision
