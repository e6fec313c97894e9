// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/landmarks/landmark_distance.hpp"

namespace panvo::landmarks {

/// Third level [Lu2015 Alg. 1]: the heading with the smallest small-scale D within 30 degrees of a start, as in the
/// paper: steps of 10, 3.33 and 1.11 degrees. `second_distance` is the smallest at headings more than 15 degrees from
/// the start.
HeadingMatch search_heading_grid(const QueryDescription& query, const PanoramaDescription& landmark, double start_rad);

/// The same, refined: descent to the best column, parabola over D, then robust alignment of the small-scale features.
HeadingMatch search_heading(const QueryDescription& query, const PanoramaDescription& landmark, double start_rad);

}  // namespace panvo::landmarks
