// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

namespace panvo::panoramic_compass {

/// Distance D over the displacement of a patch in steps of one column [Lu2015 Eq. 11].
struct DistanceCurve {
  int first = 0;                 ///< px, displacement of distances[0]
  std::vector<float> distances;  ///< 0 (identical) to 1

  float mean() const;
};

/// Minimum of a curve.
struct CurveMinimum {
  double displacement = 0.0;  ///< px, vertex of a parabola through the smallest value and its neighbours
  double distance = 1.0;      ///< at the minimum
  double curvature = 0.0;     ///< of the parabola, per px^2
  double relative = 1.0;      ///< distance / mean of the curve; about 1 if nothing resembles the patch
  bool at_border = false;     ///< the minimum lies at an end of the curve; the true one may lie beyond
};

/// Minimum of a curve; nullopt for fewer than three values.
std::optional<CurveMinimum> find_minimum(const DistanceCurve& curve);

}  // namespace panvo::panoramic_compass
