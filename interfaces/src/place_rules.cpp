// SPDX-License-Identifier: Apache-2.0
#include "panvo/interfaces/place_rules.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

namespace panvo::interfaces {
namespace {

constexpr std::size_t kMaxBins = 4096;
constexpr float kMaxPoint_m = 1e6F;     // of point coordinates; that far away only the bearing matters
constexpr float kMaxValue = 1e6F;       // of a normalised response, its spread, or a size in px
constexpr double kSumTolerance = 1e-3;  // rounding of floats over many bins

/// Number in the "key=value" line of `key`; nullopt if there is no such line or it holds no number.
std::optional<std::size_t> setting(std::string_view settings, std::string_view key) {
  while (!settings.empty()) {
    const auto line = settings.substr(0, settings.find('\n'));
    settings.remove_prefix(std::min(line.size() + 1, settings.size()));
    if (line.size() <= key.size() || !line.starts_with(key) || line[key.size()] != '=') continue;
    std::size_t value = 0;
    const auto* const end = line.data() + line.size();
    const auto [next, error] = std::from_chars(line.data() + key.size() + 1, end, value);
    return error == std::errc() && next == end ? std::optional(value) : std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

DescriptionSize description_size(std::string_view settings) {
  const auto patches = setting(settings, "patches").value_or(kMaxPatches);
  return {2 * std::min(patches, kMaxPatches), setting(settings, "histogram_bins")};
}

void check_histogram(Check& check, std::span<const float> histogram, const DescriptionSize& size) {
  check.require(!histogram.empty(), "histogram", "is empty").at_most("histogram", histogram.size(), kMaxBins);
  check.require(!size.bins || histogram.size() == *size.bins, "histogram",
                "does not have as many bins as the settings specify");
  if (!check.holds()) return;
  const bool are_shares = std::ranges::all_of(histogram, [](float share) { return share >= 0.0F; });
  const double sum = std::accumulate(histogram.begin(), histogram.end(), 0.0);
  check.require(are_shares && std::abs(sum - 1.0) <= kSumTolerance, "histogram",
                "has negative values or does not sum to 1");
}

FeatureRule::FeatureRule(Check& check, std::string_view list, std::size_t count, const DescriptionSize& size)
    : check_(check), list_(list), rows_(size.rows) {
  check_.at_most(list_, count, rows_);
}

void FeatureRule::check(std::uint16_t row, float value, float scale, float weight) {
  check_.require(row < rows_, {list_, "row"}, "is not a row of the measurement matrix");
  check_.require(std::abs(value) <= kMaxValue, {list_, "value"}, "is beyond +-1e+06 or not finite");
  // 0 is valid: the patch looked the same from everywhere nearby. Distances use a minimum spread.
  check_.require(scale >= 0.0F && scale <= kMaxValue, {list_, "scale"}, "is negative, above 1e+06 or not finite");
  check_.require(weight >= 0.0F && weight <= 1.0F, {list_, "weight"}, "is not between 0 and 1");
  check_.require(!(weight > last_weight_), {list_, "weight"}, "is not in descending order");
  last_weight_ = weight;
}

void check_keypoint(Check& check, const std::array<float, 3>& bearing, float size_px, bool has_point,
                    const std::array<float, 3>& point, float inverse_range_sigma) {
  const double length = std::hypot(double{bearing[0]}, double{bearing[1]}, double{bearing[2]});
  check.require(std::abs(length - 1.0) <= kUnitTolerance, {"keypoints", "bearing"}, "is not a unit vector");
  check.require(size_px >= 0.0F && size_px <= kMaxValue, {"keypoints", "size_px"},
                "is negative, above 1e+06 or not finite");
  const bool is_near = std::ranges::all_of(point, [](float value) { return std::abs(value) <= kMaxPoint_m; });
  check.require(is_near, {"keypoints", "point"}, "is beyond +-1e+06 or not finite");
  const float min_sigma = has_point ? 0.0F : -kMaxValue;  // not used without a point
  check.require(inverse_range_sigma >= min_sigma && inverse_range_sigma <= kMaxValue,
                {"keypoints", "inverse_range_sigma"}, "is negative, above 1e+06 or not finite");
}

}  // namespace panvo::interfaces
