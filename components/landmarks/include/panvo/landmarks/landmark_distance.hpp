// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "panvo/landmarks/panorama_describer.hpp"
#include "panvo/landmarks/panoramic_landmark.hpp"

namespace panvo::landmarks {

/// Distance of a query from a landmark [Lu2015 Eq. 11]. The paper leaves d and its normalisation open. It is computed
/// in two steps:
///
/// D of a heading: the mean, weighted by h, of min(1, |difference of the responses| / spread). The spread is that of
/// the landmark's own response over the full turn. Truncation limits the effect of patches that are occluded or
/// displaced by parallax.
///
/// Relative distance of a match: D at the best heading divided by the mean D over all headings, which is the D expected
/// of a wrong place. Noise, haze, occlusion and landmarks with little contrast to other views raise both values, so the
/// ratio is stable. It is 0 for the same panorama and about 0.9 to 1 for another place.
struct HeadingMatch {
  double heading_rad = 0.0;      ///< yaw now minus yaw at the landmark's panorama, left positive, (-pi, pi]
  float distance = 1.0F;         ///< relative, 0 to 1, at this heading
  float second_distance = 1.0F;  ///< the smallest at headings at least 20 degrees away: a measure of ambiguity
};

/// First level [Lu2015 5.1]: 0 to 1.
float histogram_distance(const QueryDescription& query, const PanoramaDescription& landmark);

/// D [Lu2015 Eq. 11] of the large- or small-scale features with the query at a heading (rad, rounded to whole columns).
float large_scale_distance(const QueryDescription& query, const PanoramaDescription& landmark, double heading_rad);
float small_scale_distance(const QueryDescription& query, const PanoramaDescription& landmark, double heading_rad);

/// Mean D of the small-scale features over the full turn: the divisor of the relative distance.
float mean_small_scale_distance(const QueryDescription& query, const PanoramaDescription& landmark);

/// Second level: the best of all headings of the query's grid, by large-scale features.
HeadingMatch match_large_scale(const QueryDescription& query, const PanoramaDescription& landmark);

}  // namespace panvo::landmarks
