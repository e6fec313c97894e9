// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/heading_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "panvo/vision/equirectangular.hpp"

namespace panvo::landmarks {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr int kGridSize = 2;  // [Lu2015 Alg. 1]
constexpr double kReach_rad = 30.0 * kDegree;
constexpr double kSmallestStep_rad = 0.5 * kDegree;

}  // namespace

HeadingMatch search_heading_grid(const QueryDescription& query, const PanoramaDescription& landmark, double start_rad) {
  HeadingMatch best{start_rad, small_scale_distance(query, landmark, start_rad), 1.0F};
  for (double step = kReach_rad / (kGridSize + 1); step > kSmallestStep_rad; step /= kGridSize + 1) {
    const double start = best.heading_rad;
    for (int i = -kGridSize; i <= kGridSize; ++i) {
      const double heading = start + i * step;
      const float distance = small_scale_distance(query, landmark, heading);
      if (distance < best.distance) {
        best.heading_rad = heading;
        best.distance = distance;
      }
    }
  }
  best.heading_rad = vision::wrap(best.heading_rad, kTurn);
  return best;
}

HeadingMatch search_heading(const QueryDescription& query, const PanoramaDescription& landmark, double start_rad) {
  HeadingMatch match = search_heading_grid(query, landmark, start_rad);
  const double column_rad = kTurn / query.images.columns();
  int column = static_cast<int>(std::lround(match.heading_rad / column_rad));
  const auto at = [&](int u) { return small_scale_distance(query, landmark, u * column_rad); };
  float here = at(column), left = at(column - 1), right = at(column + 1);
  for (int i = 0; i < 16 && (left < here || right < here); ++i) {  // downhill, column by column
    if (left < right) {
      right = here, here = left, left = at(--column - 1);
    } else {
      left = here, here = right, right = at(++column + 1);
    }
  }
  const float curvature = left - 2.0F * here + right;
  const double between = curvature > 0.0F ? std::clamp(0.5 * (left - right) / curvature, -0.5, 0.5) : 0.0;
  match.heading_rad = vision::wrap((column + between) * column_rad, kTurn);
  match.distance = here;
  return match;
}

}  // namespace panvo::landmarks
