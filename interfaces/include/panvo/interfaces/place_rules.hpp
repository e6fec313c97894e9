// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "panvo/interfaces/check.hpp"

/// Rules for the description of a place, in a message or in a store.
namespace panvo::interfaces {

/// The highest id of a landmark. Higher ones, from a damaged record or a hostile sender, are refused, because those after
/// it are counted from it on: past 32 bits, they would begin at 0 again.
inline constexpr std::uint32_t kMaxLandmarkId = 4'000'000'000;

inline constexpr std::size_t kMaxPatches = 10'000;  ///< rows of a measurement matrix
inline constexpr std::size_t kMaxKeypoints = 20'000;
inline constexpr std::size_t kMaxThumbnail = 4 << 20;  ///< bytes

/// Size of a description according to its settings. The defaults are the maximum.
struct DescriptionSize {
  std::size_t rows = 2 * kMaxPatches;  ///< intensity rows, then as many SURF rows
  std::optional<std::size_t> bins;     ///< of the histogram; nullopt: any number
};

/// Reads "patches" and "histogram_bins" from "key=value" lines; keeps the default for a missing or invalid one.
DescriptionSize description_size(std::string_view settings);

/// The histogram has the number of bins of the settings, no negative value, and sum 1.
void check_histogram(Check& check, std::span<const float> histogram, const DescriptionSize& size);

/// Checks the features of a list one after another; their weights must not increase.
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

/// `bearing`: unit vector; `point`: m; `inverse_range_sigma`: 1/m, not used without a point.
void check_keypoint(Check& check, const std::array<float, 3>& bearing, float size_px, bool has_point,
                    const std::array<float, 3>& point, float inverse_range_sigma);

}  // namespace panvo::interfaces
