// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "panvo/evaluation/place_method.hpp"

namespace panvo::evaluation {

/// BRIEF-Gist adapted to panoramas, a stronger baseline: 36 overlapping tiles of 60x60 px, one every 10 degrees of
/// azimuth, also across the seam (1152 bytes), compared at each of the 36 cyclic shifts. The distance is the smallest
/// fraction of differing bits; the heading is that of its shift, refined by a parabola through the neighbours.
std::unique_ptr<PlaceMethod> cyclic_brief_gist(std::uint64_t seed);

}  // namespace panvo::evaluation
