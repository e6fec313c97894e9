// SPDX-License-Identifier: Apache-2.0
#include "panvo/position_corrector/curve_steepness.hpp"

#include <algorithm>
#include <cmath>

namespace panvo::position_corrector {
namespace {

constexpr int kMinSamples = 4;            // two determine the line, two more check it
constexpr double kMinVariance_m2 = 0.01;  // variance of the path below which the vehicle stands still

}  // namespace

std::optional<double> curve_slope(std::span<const DistanceSample> curve, double way_m) {
  const auto lowest = std::min_element(curve.begin(), curve.end(),
                                       [](const auto& a, const auto& b) { return a.distance < b.distance; });
  if (lowest == curve.end()) return std::nullopt;
  double count = 0.0, way = 0.0, squares = 0.0, distance = 0.0, products = 0.0;
  for (const auto& sample : curve) {
    const double away_m = std::abs(sample.travelled_m - lowest->travelled_m);
    if (!(away_m <= way_m)) continue;
    count += 1.0;
    way += away_m;
    squares += away_m * away_m;
    distance += sample.distance;
    products += away_m * sample.distance;
  }
  const double variance_m2 = squares / count - (way / count) * (way / count);
  if (count < kMinSamples || variance_m2 < kMinVariance_m2) return std::nullopt;
  return (products / count - way / count * distance / count) / variance_m2;
}

bool is_steep(std::span<const DistanceSample> curve, const SteepnessParameters& parameters) {
  const auto slope = curve_slope(curve, parameters.way_m);
  return slope && *slope >= parameters.min_slope;
}

}  // namespace panvo::position_corrector
