// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "panvo/evaluation/place_method.hpp"

namespace panvo::evaluation {

/// BRIEF-Gist made for panoramas, the opponent to beat: a tile of 60x60 px about every tenth degree of azimuth (36, overlapping,
/// across the seam; 1152 bytes), compared at each of the 36 cyclic shifts. The distance is the smallest share of bits that
/// differ; the heading that of the shift, refined by a parabola through its neighbours.
std::unique_ptr<PlaceMethod> cyclic_brief_gist(std::uint64_t seed);

}  // namespace panvo::evaluation
