// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

/// Bilinear look-ups through a table of four bytes a pixel, for tables that are made once and used on every image. Integer
/// arithmetic that gives the same bytes on every machine: AVX2 where the processor has it, plain C++ where not.
///
/// A value is the mean of four neighbours with weights in 1/32 of a pixel, as of OpenCV's remap, times factor / 256.
namespace panvo::vision {

inline constexpr int kLookupFraction = 32;                             ///< steps of a pixel
inline constexpr std::uint32_t kLargestLookupOffset = (1U << 22) - 1;  ///< px
inline constexpr int kUnitFactor = 256;
inline constexpr int kLargestFactor = 1023;

/// Upper left of four neighbours, counted in pixels from where LookupSource begins, and the place between them in 1/32 px.
constexpr std::uint32_t pack_lookup(std::uint32_t offset_px, std::uint32_t fraction_x, std::uint32_t fraction_y) {
  return offset_px << 10 | fraction_y << 5 | fraction_x;
}

/// Whether the four neighbours to the right and below of (x, y) may be looked up in an image of this size: up to four pixels, or
/// eight bytes, are read of each of the two rows, and nothing is read beyond the image's last byte.
constexpr bool may_be_looked_up(int x, int y, int width, int height) {
  return x >= 0 && y >= 0 && x <= width - 2 && y <= height - 2 && (y < height - 2 || x <= width - 4);
}

/// Pixels of 8 bits; the look-ups were packed for rows of `row_px` without gaps.
struct LookupSource {
  const std::uint8_t* begin = nullptr;
  int row_px = 0;
  int factor = kUnitFactor;  ///< 0 to kLargestFactor
};

/// Looks up `count` values of `channels` bytes, 1 or 3.
void look_up(const LookupSource& source, const std::uint32_t* lookups, int count, int channels,
             std::uint8_t* destination);

/// The same of two images of which the second has weights [i] / 256.
void look_up_blended(const LookupSource& first, const std::uint32_t* first_lookups, const LookupSource& second,
                     const std::uint32_t* second_lookups, const std::uint8_t* weights, int count, int channels,
                     std::uint8_t* destination);

/// Has what these look-ups will read brought into the cache meanwhile.
void prefetch_lookups(const LookupSource& source, const std::uint32_t* lookups, int count, int channels);

}  // namespace panvo::vision
