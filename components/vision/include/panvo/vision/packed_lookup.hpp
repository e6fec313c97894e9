// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

/// Bilinear look-up through a precomputed table with four bytes per pixel. Integer arithmetic gives the same bytes on
/// every machine: AVX2 if the processor supports it, else plain C++.
///
/// A value is the mean of four neighbours with weights in steps of 1/32 px, as in OpenCV's remap, times factor / 256.
namespace panvo::vision {

inline constexpr int kLookupFraction = 32;                         ///< steps per pixel
inline constexpr std::uint32_t kMaxLookupOffset = (1U << 22) - 1;  ///< px
inline constexpr int kUnitFactor = 256;
inline constexpr int kMaxFactor = 1023;

/// Offset of the upper left of the four neighbours from LookupSource::begin, in pixels, and the fractional position in
/// 1/32 px.
constexpr std::uint32_t pack_lookup(std::uint32_t offset_px, std::uint32_t fraction_x, std::uint32_t fraction_y) {
  return offset_px << 10 | fraction_y << 5 | fraction_x;
}

/// Whether a look-up at (x, y) stays within an image of this size. Up to four pixels (grey) or eight bytes (colour) are
/// read from each of the two rows.
constexpr bool may_be_looked_up(int x, int y, int width, int height) {
  return x >= 0 && y >= 0 && x <= width - 2 && y <= height - 2 && (y < height - 2 || x <= width - 4);
}

/// 8-bit image with contiguous rows of `row_px` pixels, for which the look-ups were packed.
struct LookupSource {
  const std::uint8_t* begin = nullptr;
  int row_px = 0;
  int factor = kUnitFactor;  ///< 0 to kMaxFactor
};

/// Looks up `count` pixels of `channels` bytes each, 1 or 3. Throws std::invalid_argument for other numbers of
/// channels.
void look_up(const LookupSource& source, const std::uint32_t* lookups, int count, int channels,
             std::uint8_t* destination);

/// Blends look-ups of two images; the second has weight weights[i] / 256.
void look_up_blended(const LookupSource& first, const std::uint32_t* first_lookups, const LookupSource& second,
                     const std::uint32_t* second_lookups, const std::uint8_t* weights, int count, int channels,
                     std::uint8_t* destination);

/// Prefetches the pixels that these look-ups will read.
void prefetch_lookups(const LookupSource& source, const std::uint32_t* lookups, int count, int channels);

}  // namespace panvo::vision
