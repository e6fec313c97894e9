// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace panvo::landmarks {

/// A feature of a landmark in a LargeScaleIndex. Its term at a heading: min(cap, |response - value| * factor / 65536).
struct IndexedFeature {
  std::uint16_t row;
  std::int16_t value;
  std::uint16_t factor, cap;
};

/// Adds the terms of all features to the sums, one per heading. `responses`: of one row after the other, each padded to
/// `sums.size()`, a multiple of `lanes`. Same integers for each instruction set.
struct LargeScaleKernel {
  std::size_t lanes;
  void (*add_terms)(std::span<const IndexedFeature> features, const std::int16_t* responses,
                    std::span<std::uint16_t> sums);
};

extern const LargeScaleKernel kLargeScalePlain;
extern const LargeScaleKernel kLargeScaleAvx2;  ///< x86-64 only

}  // namespace panvo::landmarks
