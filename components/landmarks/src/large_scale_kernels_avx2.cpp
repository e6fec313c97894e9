// SPDX-License-Identifier: Apache-2.0
#if defined(__x86_64__)
#include <immintrin.h>

#include "large_scale_kernels.hpp"

#define PANVO_AVX2 __attribute__((target("avx2")))

namespace panvo::landmarks {
namespace {

constexpr std::size_t kAvx2Lanes = 16;

/// For `vectors` times 16 headings, whose sums stay in registers.
template <std::size_t vectors>
PANVO_AVX2 void add_terms_avx2_of(std::span<const IndexedFeature> features, const std::int16_t* responses,
                                  std::size_t stride, std::uint16_t* sums) {
  __m256i sum[vectors];
  for (std::size_t i = 0; i < vectors; ++i) {
    sum[i] = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(sums + i * kAvx2Lanes));
  }
  for (const IndexedFeature& feature : features) {
    const std::int16_t* row = responses + feature.row * stride;
    const __m256i value = _mm256_set1_epi16(feature.value);
    const __m256i factor = _mm256_set1_epi16(static_cast<std::int16_t>(feature.factor));
    const __m256i cap = _mm256_set1_epi16(static_cast<std::int16_t>(feature.cap));
    for (std::size_t i = 0; i < vectors; ++i) {
      const __m256i response = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(row + i * kAvx2Lanes));
      const __m256i difference = _mm256_sub_epi16(_mm256_max_epi16(response, value), _mm256_min_epi16(response, value));
      sum[i] = _mm256_adds_epu16(sum[i], _mm256_min_epu16(cap, _mm256_mulhi_epu16(difference, factor)));
    }
  }
  for (std::size_t i = 0; i < vectors; ++i) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(sums + i * kAvx2Lanes), sum[i]);
  }
}

PANVO_AVX2 void add_terms_avx2(std::span<const IndexedFeature> features, const std::int16_t* responses,
                               std::span<std::uint16_t> sums) {
  const std::size_t stride = sums.size();
  std::size_t i = 0;
  for (; i + 3 * kAvx2Lanes <= stride; i += 3 * kAvx2Lanes) {
    add_terms_avx2_of<3>(features, responses + i, stride, sums.data() + i);
  }
  for (; i < stride; i += kAvx2Lanes) add_terms_avx2_of<1>(features, responses + i, stride, sums.data() + i);
}

}  // namespace

const LargeScaleKernel kLargeScaleAvx2{kAvx2Lanes, add_terms_avx2};

}  // namespace panvo::landmarks
#endif
