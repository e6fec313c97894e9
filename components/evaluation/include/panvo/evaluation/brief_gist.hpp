// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "panvo/evaluation/place_method.hpp"

namespace panvo::evaluation {

/// BRIEF-Gist as published (Sünderhauf and Protzel 2011), the baseline of [Lu2015 7.1]. The image is scaled down and
/// divided into tiles of 60x60 px with one 256-bit BRIEF descriptor each; the distance is the fraction of differing
/// bits. It uses the same band of the panorama as the compressive features, 7 tiles (224 bytes). It does not estimate a
/// heading.
std::unique_ptr<PlaceMethod> brief_gist(std::uint64_t seed);

}  // namespace panvo::evaluation
