// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "panvo/evaluation/place_method.hpp"

namespace panvo::evaluation {

/// Fourier signature (Menegatti, Maeda and Ishiguro 2004). The band is averaged to 15 rows and normalised for gain and
/// offset; the first 15 harmonics along the azimuth are kept for each row. A rotation changes only their phases. The
/// distance is the L1 distance of the magnitudes divided by their sum; the heading is the one of best phase agreement,
/// over the full circle.
std::unique_ptr<PlaceMethod> fourier_signature();

}  // namespace panvo::evaluation
