// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/heading_search.hpp"

#include <algorithm>
#include <cmath>

#include "heading_alignment.hpp"
#include "panvo/vision/angle.hpp"
#include "panvo/vision/equirectangular.hpp"
#include "turn.hpp"

namespace panvo::landmarks {
namespace {

constexpr int kGridSize = 2;  // [Lu2015 Alg. 1]
constexpr double kReach_rad = 30.0 * vision::kDegree;
constexpr double kMinStep_rad = 0.5 * vision::kDegree;
constexpr double kNeighbourhood_rad = 15.0 * vision::kDegree;  // of the start: farther is a different heading
constexpr int kMaxColumns = 16;                                // of the descent: more than the grid's last step

/// D at a column and its neighbours, for the descent.
struct Valley {
  int column;
  float left, here, right;
};

/// [Alg. 1]; `distance` is D.
HeadingMatch search_grid(const QueryDescription& query, const PanoramaDescription& landmark, double start_rad) {
  HeadingMatch best{start_rad, small_scale_distance(query, landmark, start_rad), 1.0F};
  for (double step = kReach_rad / (kGridSize + 1); step > kMinStep_rad; step /= kGridSize + 1) {
    const double start = best.heading_rad;
    for (int i = -kGridSize; i <= kGridSize; ++i) {
      const double heading = start + i * step;
      const float distance = small_scale_distance(query, landmark, heading);
      const bool is_far = std::abs(heading - start_rad) > kNeighbourhood_rad;
      if (is_far) best.second_distance = std::min(best.second_distance, distance);
      if (distance < best.distance) {
        best.heading_rad = heading;
        best.distance = distance;
      }
    }
  }
  return best;
}

HeadingMatch relative(HeadingMatch match, float mean) {
  match.heading_rad = vision::wrap(match.heading_rad, kTurn);
  match.distance = std::min(1.0F, match.distance / mean);
  match.second_distance = std::min(1.0F, match.second_distance / mean);
  return match;
}

}  // namespace

HeadingMatch search_heading_grid(const QueryDescription& query, const PanoramaDescription& landmark, double start_rad) {
  return relative(search_grid(query, landmark, start_rad), mean_small_scale_distance(query, landmark));
}

HeadingMatch search_heading(const QueryDescription& query, const PanoramaDescription& landmark, double start_rad) {
  HeadingMatch match = search_grid(query, landmark, start_rad);
  const double column_rad = kTurn / query.images.columns();
  const auto at = [&](int u) { return small_scale_distance(query, landmark, u * column_rad); };
  const int nearest = static_cast<int>(std::lround(match.heading_rad / column_rad));
  Valley valley{nearest, at(nearest - 1), at(nearest), at(nearest + 1)};
  for (int i = 0; i < kMaxColumns && (valley.left < valley.here || valley.right < valley.here); ++i) {
    if (valley.left < valley.right) {
      valley = {valley.column - 1, at(valley.column - 2), valley.left, valley.here};
    } else {
      valley = {valley.column + 1, valley.here, valley.right, at(valley.column + 2)};
    }
  }
  const float curvature = valley.left - 2.0F * valley.here + valley.right;
  const double between = curvature > 0.0F ? std::clamp(0.5 * (valley.left - valley.right) / curvature, -0.5, 0.5) : 0.0;
  match.heading_rad = align_heading(query, landmark, (valley.column + between) * column_rad);
  match.distance = valley.here;
  return relative(match, mean_small_scale_distance(query, landmark));
}

}  // namespace panvo::landmarks
