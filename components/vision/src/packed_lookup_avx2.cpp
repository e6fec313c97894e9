// SPDX-License-Identifier: Apache-2.0
#if defined(__x86_64__)
#include <immintrin.h>

#include <cstring>

#include "packed_lookup_kernels.hpp"

#define PANVO_AVX2 __attribute__((target("avx2")))

/// Eight look-ups at a time. Horizontal neighbours are summed first (bytes, weights up to 32), then the two rows (16
/// bits, weights up to 32 * factor < 2^15), with the same integer results as the plain version.
namespace panvo::vision {
namespace {

constexpr int kLanes = 8;
constexpr int kBlock = 64;  // look-ups fetched before processing; fits into the L1 cache

/// Eight unpacked look-ups, one per 32-bit lane.
struct Unpacked {
  __m256i offset_px;
  __m256i across;  ///< four bytes: 32 - x, x, 32 - x, x
  __m256i down;    ///< two words: (32 - y) * factor, y * factor
};

PANVO_AVX2 inline Unpacked unpack(const std::uint32_t* lookups, __m256i factor_words) {
  const __m256i packed = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(lookups));
  const __m256i low = _mm256_set1_epi32(31);
  const __m256i x = _mm256_and_si256(packed, low);
  const __m256i y = _mm256_and_si256(_mm256_srli_epi32(packed, 5), low);
  const __m256i x_words = _mm256_or_si256(x, _mm256_slli_epi32(x, 16));
  const __m256i rest = _mm256_sub_epi16(_mm256_set1_epi16(32), x_words);
  const __m256i y_words = _mm256_or_si256(_mm256_sub_epi32(_mm256_set1_epi32(32), y), _mm256_slli_epi32(y, 16));
  return {_mm256_srli_epi32(packed, 10), _mm256_or_si256(rest, _mm256_slli_epi16(x_words, 8)),
          _mm256_mullo_epi16(y_words, factor_words)};
}

/// Copies the factor to both 16-bit words of each lane.
PANVO_AVX2 inline __m256i in_words(__m256i factors) { return _mm256_or_si256(factors, _mm256_slli_epi32(factors, 16)); }

/// Factors of eight pixels with these weights.
PANVO_AVX2 inline __m256i shares(int factor, __m256i weights) {
  const __m256i product = _mm256_mullo_epi32(_mm256_set1_epi32(factor), weights);
  return in_words(_mm256_srli_epi32(_mm256_add_epi32(product, _mm256_set1_epi32(128)), 8));
}

PANVO_AVX2 inline __m256i load_weights(const std::uint8_t* weights) {
  return _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(weights)));
}

PANVO_AVX2 inline __m256i complement(__m256i weights) { return _mm256_sub_epi32(_mm256_set1_epi32(256), weights); }

/// Fetches the four neighbours of up to kBlock look-ups, one byte each: two of the upper row, two of the lower row.
/// Uses plain independent loads: with the microcode mitigation of its side channel, a gather instruction takes three
/// times as long.
PANVO_AVX2 inline void fetch_grey(const LookupSource& source, const std::uint32_t* lookups, int count,
                                  std::uint32_t* four) {
  const std::uint8_t* upper_row = source.begin;
  const std::uint8_t* lower_row = source.begin + source.row_px;
#pragma GCC unroll 8
  for (int i = 0; i < count; ++i) {
    const std::size_t offset = lookups[i] >> 10;
    std::uint16_t upper = 0, lower = 0;
    std::memcpy(&upper, upper_row + offset, sizeof upper);
    std::memcpy(&lower, lower_row + offset, sizeof lower);
    four[i] = upper | std::uint32_t{lower} << 16;
  }
}

PANVO_AVX2 inline __m256i grey_sums(const std::uint32_t* four, const std::uint32_t* lookups, __m256i factor_words) {
  const Unpacked at = unpack(lookups, factor_words);
  const __m256i neighbours = _mm256_load_si256(reinterpret_cast<const __m256i*>(four));
  return _mm256_madd_epi16(_mm256_maddubs_epi16(neighbours, at.across), at.down);
}

PANVO_AVX2 inline __m256i round_sums(__m256i sums) {
  return _mm256_srli_epi32(_mm256_add_epi32(sums, _mm256_set1_epi32(1 << (kLookupShift - 1))), kLookupShift);
}

PANVO_AVX2 inline void store_grey(__m256i values, std::uint8_t* destination) {
  const __m128i words = _mm_packus_epi32(_mm256_castsi256_si128(values), _mm256_extracti128_si256(values, 1));
  _mm_storel_epi64(reinterpret_cast<__m128i*>(destination), _mm_packus_epi16(words, words));
}

PANVO_AVX2 void grey_one(const LookupSource& source, const std::uint32_t* lookups, int count,
                         std::uint8_t* destination) {
  const __m256i factor_words = in_words(_mm256_set1_epi32(source.factor));
  alignas(32) std::uint32_t four[kBlock];
  int i = 0;
  while (count - i >= kLanes) {
    const int block = std::min(kBlock, (count - i) / kLanes * kLanes);
    fetch_grey(source, lookups + i, block, four);
    for (int at = 0; at < block; at += kLanes, i += kLanes)
      store_grey(round_sums(grey_sums(four + at, lookups + i, factor_words)), destination + i);
  }
  look_up_plain<1>(source, lookups + i, count - i, destination + i);
}

PANVO_AVX2 void grey_blended(const LookupSource& first, const std::uint32_t* first_lookups, const LookupSource& second,
                             const std::uint32_t* second_lookups, const std::uint8_t* weights, int count,
                             std::uint8_t* destination) {
  alignas(32) std::uint32_t first_four[kBlock], second_four[kBlock];
  int i = 0;
  while (count - i >= kLanes) {
    const int block = std::min(kBlock, (count - i) / kLanes * kLanes);
    fetch_grey(first, first_lookups + i, block, first_four);
    fetch_grey(second, second_lookups + i, block, second_four);
    for (int at = 0; at < block; at += kLanes, i += kLanes) {
      const __m256i weight = load_weights(weights + i);
      const __m256i sums =
          _mm256_add_epi32(grey_sums(first_four + at, first_lookups + i, shares(first.factor, complement(weight))),
                           grey_sums(second_four + at, second_lookups + i, shares(second.factor, weight)));
      store_grey(round_sums(sums), destination + i);
    }
  }
  blend_plain<1>(first, first_lookups + i, second, second_lookups + i, weights + i, count - i, destination + i);
}

/// Sums of three colours for eight pixels: four 32-bit lanes per pixel, the last one unused.
struct ColourSums {
  __m128i of[kLanes];
};

PANVO_AVX2 inline ColourSums colour_sums(const LookupSource& source, const std::uint32_t* lookups,
                                         __m256i factor_words) {
  const Unpacked at = unpack(lookups, factor_words);
  alignas(32) std::int32_t offsets[kLanes], across[kLanes], down[kLanes];
  const __m256i bytes = _mm256_add_epi32(at.offset_px, _mm256_slli_epi32(at.offset_px, 1));
  _mm256_store_si256(reinterpret_cast<__m256i*>(offsets), bytes);
  _mm256_store_si256(reinterpret_cast<__m256i*>(across), at.across);
  _mm256_store_si256(reinterpret_cast<__m256i*>(down), at.down);
  const std::ptrdiff_t step = std::ptrdiff_t{source.row_px} * 3;
  // per colour: upper left, upper right, lower left, lower right
  const __m128i order = _mm_setr_epi8(0, 3, 8, 11, 1, 4, 9, 12, 2, 5, 10, 13, -1, -1, -1, -1);
  ColourSums sums;
  for (int i = 0; i < kLanes; ++i) {
    const std::uint8_t* upper = source.begin + offsets[i];
    const __m128i above = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(upper));
    const __m128i both =
        _mm_castpd_si128(_mm_loadh_pd(_mm_castsi128_pd(above), reinterpret_cast<const double*>(upper + step)));
    const __m128i rows = _mm_maddubs_epi16(_mm_shuffle_epi8(both, order), _mm_set1_epi32(across[i]));
    sums.of[i] = _mm_madd_epi16(rows, _mm_set1_epi32(down[i]));
  }
  return sums;
}

PANVO_AVX2 inline __m128i round_colour(__m128i sums) {
  return _mm_srli_epi32(_mm_add_epi32(sums, _mm_set1_epi32(1 << (kLookupShift - 1))), kLookupShift);
}

PANVO_AVX2 inline void store_colour(const ColourSums& sums, std::uint8_t* destination) {
  const __m128i close_up = _mm_setr_epi8(0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14, -1, -1, -1, -1);
  for (int i = 0; i < kLanes; i += 4) {
    const __m128i a = _mm_packus_epi32(round_colour(sums.of[i]), round_colour(sums.of[i + 1]));
    const __m128i b = _mm_packus_epi32(round_colour(sums.of[i + 2]), round_colour(sums.of[i + 3]));
    const __m128i twelve = _mm_shuffle_epi8(_mm_packus_epi16(a, b), close_up);
    _mm_storel_epi64(reinterpret_cast<__m128i*>(destination + 3 * i), twelve);
    const int last = _mm_extract_epi32(twelve, 2);
    std::memcpy(destination + 3 * i + 8, &last, sizeof last);
  }
}

PANVO_AVX2 void colour_one(const LookupSource& source, const std::uint32_t* lookups, int count,
                           std::uint8_t* destination) {
  const __m256i factor_words = in_words(_mm256_set1_epi32(source.factor));
  int i = 0;
  for (; i + kLanes <= count; i += kLanes)
    store_colour(colour_sums(source, lookups + i, factor_words), destination + 3 * i);
  look_up_plain<3>(source, lookups + i, count - i, destination + 3 * i);
}

PANVO_AVX2 void colour_blended(const LookupSource& first, const std::uint32_t* first_lookups,
                               const LookupSource& second, const std::uint32_t* second_lookups,
                               const std::uint8_t* weights, int count, std::uint8_t* destination) {
  int i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    const __m256i weight = load_weights(weights + i);
    ColourSums sums = colour_sums(first, first_lookups + i, shares(first.factor, complement(weight)));
    const ColourSums more = colour_sums(second, second_lookups + i, shares(second.factor, weight));
    for (int pixel = 0; pixel < kLanes; ++pixel) sums.of[pixel] = _mm_add_epi32(sums.of[pixel], more.of[pixel]);
    store_colour(sums, destination + 3 * i);
  }
  blend_plain<3>(first, first_lookups + i, second, second_lookups + i, weights + i, count - i, destination + 3 * i);
}

}  // namespace

const LookupKernels kGreyLookupAvx2{grey_one, grey_blended};
const LookupKernels kColourLookupAvx2{colour_one, colour_blended};

}  // namespace panvo::vision
#endif
