// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/landmarks/panorama_describer.hpp"

namespace panvo::landmarks {

/// Heading (rad, not wrapped) near `start_rad` at which the small-scale features agree, found by robust least squares on their
/// responses. A minimum of D is drawn aside by what is covered and by parallax, which a sum of differences cannot tell from a
/// turn. Here every feature has its own shift, of a turn and of a step aside: turn + a sin(azimuth) + b cos(azimuth); what does
/// not fit loses its say.
double align_heading(const QueryDescription& query, const PanoramaDescription& landmark, double start_rad);

}  // namespace panvo::landmarks
