// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

namespace panvo::panoramic_compass {

/// D over displacements of a patch [Lu2015 Eq. 11], px, one step of a column apart.
struct DistanceCurve {
  int first = 0;                 ///< px, displacement of distances[0]
  std::vector<float> distances;  ///< 0 (the same) to 1

  float mean() const;
};

/// Where a curve is smallest.
struct CurveMinimum {
  double displacement = 0.0;  ///< px, by a parabola through the smallest value and its neighbours
  double distance = 1.0;      ///< there
  double curvature = 0.0;     ///< of the parabola, per px^2
  double relative = 1.0;      ///< distance over the curve's mean: about 1 where nothing resembles the patch
  bool at_border = false;     ///< of the curve: the true minimum may lie beyond
};

/// nullopt for fewer than three values.
std::optional<CurveMinimum> find_minimum(const DistanceCurve& curve);

}  // namespace panvo::panoramic_compass
