// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "panvo/interfaces/check.hpp"

/// What the description of a place may hold, whether it is a message or lies in a store.
namespace panvo::interfaces {

inline constexpr std::size_t kMostPatches = 10'000;  ///< of a measurement matrix
inline constexpr std::size_t kMostKeypoints = 20'000;
inline constexpr std::size_t kLargestThumbnail = 4 << 20;  ///< bytes

/// What the settings of a description say of its size; what they do not say is as large as it may be.
struct DescriptionSize {
  std::size_t rows = 2 * kMostPatches;  ///< of both halves of a measurement matrix: intensities, then gradients
  std::optional<std::size_t> bins;      ///< of the histogram
};

/// Of "key=value" lines: patches, histogram_bins.
DescriptionSize description_size(std::string_view settings);

void check_histogram(Check& check, std::span<const float> histogram, const DescriptionSize& size);

/// One feature after another, as their weights must descend.
class FeatureRule {
 public:
  FeatureRule(Check& check, std::string_view list, std::size_t count, const DescriptionSize& size);
  void check(std::uint16_t row, float value, float scale, float weight);

 private:
  Check& check_;
  std::string_view list_;
  std::size_t rows_;
  float last_weight_ = 1.0F;
};

void check_keypoint(Check& check, const std::array<float, 3>& bearing, float size_px, bool has_point,
                    const std::array<float, 3>& point, float inverse_range_sigma);

}  // namespace panvo::interfaces
