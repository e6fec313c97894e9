// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "panvo/landmarks/panorama_describer.hpp"
#include "panvo/landmarks/panoramic_landmark.hpp"

namespace panvo::landmarks {

/// A landmark compared with a query at the heading that fits best.
struct HeadingMatch {
  double heading_rad = 0.0;  ///< yaw now minus yaw at the landmark's panorama, left positive, (-pi, pi]
  float distance = 1.0F;     ///< D [Lu2015 Eq. 11], 0 to 1
  float second_distance =
      1.0F;  ///< smallest D at a heading that is not this one or its neighbourhood: how ambiguous it is
};

/// First level [Lu2015 5.1]: 0 to 1.
float histogram_distance(const QueryDescription& query, const PanoramaDescription& landmark);

/// D [Lu2015 Eq. 11] of the large- or small-scale features, the query seen at a heading (rad, rounded to whole columns).
float large_scale_distance(const QueryDescription& query, const PanoramaDescription& landmark, double heading_rad);
float small_scale_distance(const QueryDescription& query, const PanoramaDescription& landmark, double heading_rad);

/// Second level: the best of all headings of the query's grid, at the large scale.
HeadingMatch match_large_scale(const QueryDescription& query, const PanoramaDescription& landmark);

}  // namespace panvo::landmarks
