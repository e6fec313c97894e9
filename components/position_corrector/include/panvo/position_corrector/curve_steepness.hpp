// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "panvo/position_corrector/landmark_matcher.hpp"

namespace panvo::position_corrector {

struct SteepnessParameters {
  double way_m = 3.0;
  double min_slope = 0.08;

  template <class Field>
  static void describe(Field&& field) {
    using P = SteepnessParameters;
    field(&P::way_m, "way_m", "m", "length of the curve evaluated on either side of its minimum", 0.5, 20.0);
    field(&P::min_slope, "min_slope", "1/m",
          "smallest rise of the distance per metre of a steep curve: landmarks passed within 2 m have "
          "more, farther ones less",
          0.0, 1.0);
  }
};

/// Slope of D(f_s, f_ss) around its minimum, 1/m [Lu2015 5.2]: s in D = D_0 + s |path from the minimum|, by least
/// squares over the samples within `way_m` of it. A vehicle that passes through the landmark's position sees the
/// distance fall and rise sharply; one that passes at some distance sees a shallow bowl. nullopt for fewer than four
/// samples or samples at nearly one position.
std::optional<double> curve_slope(std::span<const DistanceSample> curve, double way_m);

/// Whether the curve is steep, i.e. the landmark's position may be used as that of the vehicle [Lu2015 5.2].
bool is_steep(std::span<const DistanceSample> curve, const SteepnessParameters& parameters);

}  // namespace panvo::position_corrector
