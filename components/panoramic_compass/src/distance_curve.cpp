// SPDX-License-Identifier: Apache-2.0
#include "panvo/panoramic_compass/distance_curve.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace panvo::panoramic_compass {

float DistanceCurve::mean() const {
  if (distances.empty()) return 1.0F;
  return std::accumulate(distances.begin(), distances.end(), 0.0F) / static_cast<float>(distances.size());
}

std::optional<CurveMinimum> find_minimum(const DistanceCurve& curve) {
  const std::vector<float>& d = curve.distances;
  if (d.size() < 3) return std::nullopt;
  const auto best = static_cast<std::size_t>(std::min_element(d.begin(), d.end()) - d.begin());
  CurveMinimum minimum;
  minimum.at_border = best == 0 || best + 1 == d.size();
  minimum.displacement = curve.first + static_cast<double>(best);
  minimum.distance = d[best];
  const double mean = curve.mean();
  minimum.relative = mean > 0.0 ? minimum.distance / mean : 1.0;
  if (minimum.at_border) return minimum;
  const double before = d[best - 1], here = d[best], after = d[best + 1];
  minimum.curvature = before - 2.0 * here + after;
  if (minimum.curvature > 0.0) {
    const double slope = 0.5 * (after - before);
    minimum.displacement -= slope / minimum.curvature;
    minimum.distance = std::max(0.0, here - 0.5 * slope * slope / minimum.curvature);
  }
  return minimum;
}

}  // namespace panvo::panoramic_compass
