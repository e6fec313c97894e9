// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/landmarks/panorama_describer.hpp"

namespace panvo::landmarks {

/// Heading (rad, not wrapped) near `start_rad` at which the small-scale features agree, by robust least squares on
/// their responses. Occlusion and parallax bias the minimum of D, as a sum of differences cannot separate them from a
/// rotation. Here each feature has its own shift, by rotation and parallax: turn + a sin(azimuth) + b cos(azimuth);
/// outliers are downweighted.
double align_heading(const QueryDescription& query, const PanoramaDescription& landmark, double start_rad);

}  // namespace panvo::landmarks
