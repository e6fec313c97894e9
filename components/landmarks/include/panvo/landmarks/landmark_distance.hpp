// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "panvo/landmarks/panorama_describer.hpp"
#include "panvo/landmarks/panoramic_landmark.hpp"

namespace panvo::landmarks {

/// Distance of a query from a landmark [Lu2015 Eq. 11]. The paper leaves d and its normalisation open. Ours, in two steps:
///
/// D, of a heading: the mean, weighted by h, of min(1, |difference of the responses| / spread), the spread being that of the
/// landmark's own response over the full turn. A patch that is covered, or stands where parallax shows something else, counts
/// as one that is wrong, and no more than that.
///
/// The relative distance, of a match: D at the best heading over the mean D of all headings, which is what a wrong place gives.
/// Noise, haze and cover raise both, and so does a landmark that differs little from any view; the ratio stays. It is 0 for the
/// same panorama, about 0.9 to 1 for another place.
struct HeadingMatch {
  double heading_rad = 0.0;      ///< yaw now minus yaw at the landmark's panorama, left positive, (-pi, pi]
  float distance = 1.0F;         ///< relative, 0 to 1, at this heading
  float second_distance = 1.0F;  ///< the smallest at a heading 20 degrees away or more: how ambiguous this one is
};

/// First level [Lu2015 5.1]: 0 to 1.
float histogram_distance(const QueryDescription& query, const PanoramaDescription& landmark);

/// D [Lu2015 Eq. 11] of the large- or small-scale features, the query seen at a heading (rad, rounded to whole columns).
float large_scale_distance(const QueryDescription& query, const PanoramaDescription& landmark, double heading_rad);
float small_scale_distance(const QueryDescription& query, const PanoramaDescription& landmark, double heading_rad);

/// Mean D of the small-scale features over the full turn: what turns D into the relative distance.
float mean_small_scale_distance(const QueryDescription& query, const PanoramaDescription& landmark);

/// Second level: the best of all headings of the query's grid, at the large scale.
HeadingMatch match_large_scale(const QueryDescription& query, const PanoramaDescription& landmark);

}  // namespace panvo::landmarks
