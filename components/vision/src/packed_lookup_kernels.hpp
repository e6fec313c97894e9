// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "panvo/vision/packed_lookup.hpp"

/// Common parts of the plain, the AVX2 and the NEON look-ups.
namespace panvo::vision {

/// Fraction bits of the interpolation weights (2 * 5) and the factor (8).
inline constexpr int kLookupShift = 18;

/// Kernels for one instruction set.
struct LookupKernels {
  void (*one)(const LookupSource&, const std::uint32_t*, int, std::uint8_t*);
  void (*blended)(const LookupSource&, const std::uint32_t*, const LookupSource&, const std::uint32_t*,
                  const std::uint8_t*, int, std::uint8_t*);
};

constexpr int first_factor(const LookupSource& source, int weight) {
  return (source.factor * (256 - weight) + 128) >> 8;
}
constexpr int second_factor(const LookupSource& source, int weight) { return (source.factor * weight + 128) >> 8; }

/// Weighted sum of four neighbours of one channel, in 1/2^18 grey levels.
template <int channels>
inline std::uint32_t weighted_sum(const LookupSource& source, std::uint32_t lookup, int factor, int channel) {
  const std::uint32_t across = lookup & 31U;
  const std::uint32_t down = (lookup >> 5) & 31U;
  const std::uint8_t* upper = source.begin + std::size_t{lookup >> 10} * channels + channel;
  const std::uint8_t* lower = upper + static_cast<std::size_t>(source.row_px) * channels;
  const std::uint32_t above = upper[0] * (32 - across) + upper[channels] * across;
  const std::uint32_t below = lower[0] * (32 - across) + lower[channels] * across;
  return (above * (32 - down) + below * down) * static_cast<std::uint32_t>(factor);
}

inline std::uint8_t rounded(std::uint32_t sum) {
  return static_cast<std::uint8_t>(std::min<std::uint32_t>(255, (sum + (1U << (kLookupShift - 1))) >> kLookupShift));
}

template <int channels>
void look_up_plain(const LookupSource& source, const std::uint32_t* lookups, int count, std::uint8_t* destination) {
  for (int i = 0; i < count; ++i) {
    for (int channel = 0; channel < channels; ++channel)
      *destination++ = rounded(weighted_sum<channels>(source, lookups[i], source.factor, channel));
  }
}

template <int channels>
void blend_plain(const LookupSource& first, const std::uint32_t* first_lookups, const LookupSource& second,
                 const std::uint32_t* second_lookups, const std::uint8_t* weights, int count,
                 std::uint8_t* destination) {
  for (int i = 0; i < count; ++i) {
    const int first_share = first_factor(first, weights[i]);
    const int second_share = second_factor(second, weights[i]);
    for (int channel = 0; channel < channels; ++channel) {
      *destination++ = rounded(weighted_sum<channels>(first, first_lookups[i], first_share, channel) +
                               weighted_sum<channels>(second, second_lookups[i], second_share, channel));
    }
  }
}

#if defined(__x86_64__)
extern const LookupKernels kGreyLookupAvx2;
extern const LookupKernels kColourLookupAvx2;
#elif defined(__aarch64__)
extern const LookupKernels kGreyLookupNeon;
extern const LookupKernels kColourLookupNeon;
#endif

}  // namespace panvo::vision
