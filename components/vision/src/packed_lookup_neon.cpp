// SPDX-License-Identifier: Apache-2.0
#if defined(__aarch64__)
#include <arm_neon.h>

#include <cstring>

#include "packed_lookup_kernels.hpp"

/// Grey images: eight look-ups at a time. Colour images: one look-up at a time, its three channels in parallel. Same
/// integer results as the plain version.
namespace panvo::vision {
namespace {

constexpr int kNeonLanes = 8;

/// Interpolated values of eight grey pixels, in 1/2^10 grey levels.
struct GreyValues {
  uint32x4_t low, high;
};

inline GreyValues grey_values(const LookupSource& source, const std::uint32_t* lookups) {
  alignas(16) std::uint16_t upper[kNeonLanes], lower[kNeonLanes];
  for (int i = 0; i < kNeonLanes; ++i) {
    const std::uint8_t* at = source.begin + (lookups[i] >> 10);
    std::memcpy(upper + i, at, sizeof *upper);
    std::memcpy(lower + i, at + source.row_px, sizeof *lower);
  }
  const uint16x8_t packed = vcombine_u16(vmovn_u32(vld1q_u32(lookups)), vmovn_u32(vld1q_u32(lookups + 4)));
  const uint16x8_t low_bits = vdupq_n_u16(31), one = vdupq_n_u16(32), byte = vdupq_n_u16(255);
  const uint16x8_t across = vandq_u16(packed, low_bits);
  const uint16x8_t down = vandq_u16(vshrq_n_u16(packed, 5), low_bits);
  const uint16x8_t rest = vsubq_u16(one, across), up = vsubq_u16(one, down);
  const uint16x8_t two = vld1q_u16(upper), two_below = vld1q_u16(lower);
  const uint16x8_t above = vmlaq_u16(vmulq_u16(vandq_u16(two, byte), rest), vshrq_n_u16(two, 8), across);
  const uint16x8_t below = vmlaq_u16(vmulq_u16(vandq_u16(two_below, byte), rest), vshrq_n_u16(two_below, 8), across);
  return {vmlal_u16(vmull_u16(vget_low_u16(above), vget_low_u16(up)), vget_low_u16(below), vget_low_u16(down)),
          vmlal_high_u16(vmull_high_u16(above, up), below, down)};
}

/// Rounds sums to 16 bits, as `rounded` does, but without its limit of 255.
inline uint16x4_t round_sums_neon(uint32x4_t sums) { return vqmovn_u32(vrshrq_n_u32(sums, kLookupShift)); }

inline void store_grey_neon(uint32x4_t low, uint32x4_t high, std::uint8_t* destination) {
  vst1_u8(destination, vqmovn_u16(vcombine_u16(round_sums_neon(low), round_sums_neon(high))));
}

void grey_one_neon(const LookupSource& source, const std::uint32_t* lookups, int count, std::uint8_t* destination) {
  const auto factor = static_cast<std::uint32_t>(source.factor);
  int i = 0;
  for (; i + kNeonLanes <= count; i += kNeonLanes) {
    const GreyValues values = grey_values(source, lookups + i);
    store_grey_neon(vmulq_n_u32(values.low, factor), vmulq_n_u32(values.high, factor), destination + i);
  }
  look_up_plain<1>(source, lookups + i, count - i, destination + i);
}

/// Factor of four pixels with these weights.
inline uint32x4_t shares_neon(int factor, uint16x4_t weights) {
  return vrshrq_n_u32(vmulq_n_u32(vmovl_u16(weights), static_cast<std::uint32_t>(factor)), 8);
}

void grey_blended_neon(const LookupSource& first, const std::uint32_t* first_lookups, const LookupSource& second,
                       const std::uint32_t* second_lookups, const std::uint8_t* weights, int count,
                       std::uint8_t* destination) {
  int i = 0;
  for (; i + kNeonLanes <= count; i += kNeonLanes) {
    const GreyValues a = grey_values(first, first_lookups + i), b = grey_values(second, second_lookups + i);
    const uint16x8_t weight = vmovl_u8(vld1_u8(weights + i)), rest = vsubq_u16(vdupq_n_u16(256), weight);
    const uint32x4_t low = vmlaq_u32(vmulq_u32(a.low, shares_neon(first.factor, vget_low_u16(rest))), b.low,
                                     shares_neon(second.factor, vget_low_u16(weight)));
    const uint32x4_t high = vmlaq_u32(vmulq_u32(a.high, shares_neon(first.factor, vget_high_u16(rest))), b.high,
                                      shares_neon(second.factor, vget_high_u16(weight)));
    store_grey_neon(low, high, destination + i);
  }
  blend_plain<1>(first, first_lookups + i, second, second_lookups + i, weights + i, count - i, destination + i);
}

/// Interpolated values of the three channels of one pixel times the factor, in 1/2^18 grey levels; the last lane is
/// unused.
inline uint32x4_t colour_sums_neon(const LookupSource& source, std::uint32_t lookup, int factor) {
  const std::uint8_t* at = source.begin + std::size_t{lookup >> 10} * 3;
  const uint8x8_t upper = vld1_u8(at), lower = vld1_u8(at + static_cast<std::size_t>(source.row_px) * 3);
  const auto across = static_cast<std::uint8_t>(lookup & 31U);
  const auto down = static_cast<std::uint16_t>((lookup >> 5) & 31U);
  const uint8x8_t rest = vdup_n_u8(static_cast<std::uint8_t>(32 - across)), share = vdup_n_u8(across);
  const uint16x8_t above = vmlal_u8(vmull_u8(upper, rest), vext_u8(upper, upper, 3), share);
  const uint16x8_t below = vmlal_u8(vmull_u8(lower, rest), vext_u8(lower, lower, 3), share);
  const uint32x4_t values =
      vmlal_n_u16(vmull_n_u16(vget_low_u16(above), static_cast<std::uint16_t>(32 - down)), vget_low_u16(below), down);
  return vmulq_n_u32(values, static_cast<std::uint32_t>(factor));
}

/// Writes four bytes, of which the next pixel overwrites the last.
inline void store_colour_neon(uint32x4_t sums, std::uint8_t* destination) {
  const uint16x4_t words = round_sums_neon(sums);
  const std::uint32_t bytes = vget_lane_u32(vreinterpret_u32_u8(vqmovn_u16(vcombine_u16(words, words))), 0);
  std::memcpy(destination, &bytes, sizeof bytes);
}

void colour_one_neon(const LookupSource& source, const std::uint32_t* lookups, int count, std::uint8_t* destination) {
  int i = 0;
  for (; i + 1 < count; ++i)
    store_colour_neon(colour_sums_neon(source, lookups[i], source.factor), destination + 3 * i);
  look_up_plain<3>(source, lookups + i, count - i, destination + 3 * i);
}

void colour_blended_neon(const LookupSource& first, const std::uint32_t* first_lookups, const LookupSource& second,
                         const std::uint32_t* second_lookups, const std::uint8_t* weights, int count,
                         std::uint8_t* destination) {
  int i = 0;
  for (; i + 1 < count; ++i) {
    const uint32x4_t a = colour_sums_neon(first, first_lookups[i], first_factor(first, weights[i]));
    const uint32x4_t b = colour_sums_neon(second, second_lookups[i], second_factor(second, weights[i]));
    store_colour_neon(vaddq_u32(a, b), destination + 3 * i);
  }
  blend_plain<3>(first, first_lookups + i, second, second_lookups + i, weights + i, count - i, destination + 3 * i);
}

}  // namespace

const LookupKernels kGreyLookupNeon{grey_one_neon, grey_blended_neon};
const LookupKernels kColourLookupNeon{colour_one_neon, colour_blended_neon};

}  // namespace panvo::vision
#endif
