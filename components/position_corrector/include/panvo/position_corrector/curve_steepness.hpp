// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "panvo/position_corrector/landmark_matcher.hpp"

namespace panvo::position_corrector {

struct SteepnessParameters {
  double way_m = 3.0;
  double smallest_slope = 0.08;

  template <class Field>
  static void describe(Field&& field) {
    using P = SteepnessParameters;
    field(&P::way_m, "way_m", "m", "of the curve on either side of its minimum that is looked at", 0.5, 20.0);
    field(&P::smallest_slope, "smallest_slope", "1/m",
          "rise of the distance per metre of way from which on a curve is steep: landmarks passed within 2 m have "
          "more, farther ones less",
          0.0, 1.0);
  }
};

/// How steeply D(f_s, f_ss) rises away from its minimum, 1/m [Lu2015 5.2]: the slope s of D = D_0 + s |way from the minimum|, by
/// least squares over the samples within `way_m` of it. A vehicle that passes through the landmark's own position sees the
/// distance fall and rise sharply; one that passes at some distance sees a shallow bowl. Nothing where there are fewer than
/// four samples, or all of them lie in one spot: such a curve says nothing.
std::optional<double> curve_slope(std::span<const DistanceSample> curve, double way_m);

/// Whether the curve is steep: the landmark's position may be taken for that of the vehicle [Lu2015 5.2].
bool is_steep(std::span<const DistanceSample> curve, const SteepnessParameters& parameters);

}  // namespace panvo::position_corrector
