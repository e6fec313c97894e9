// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "panvo/evaluation/place_method.hpp"

namespace panvo::evaluation {

/// BRIEF-Gist as it was published (Sünderhauf and Protzel 2011), which [Lu2015 7.1] compares with: the image is scaled down and
/// divided into tiles of 60x60 px, each gives one BRIEF descriptor of 256 bits, and the distance is the share of bits that
/// differ. Here of the same band of the panorama as the compressive features, 7 tiles side by side (224 bytes). It knows no
/// heading.
std::unique_ptr<PlaceMethod> brief_gist(std::uint64_t seed);

}  // namespace panvo::evaluation
