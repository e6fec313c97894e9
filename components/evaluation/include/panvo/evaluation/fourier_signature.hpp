// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "panvo/evaluation/place_method.hpp"

namespace panvo::evaluation {

/// Fourier signature (Menegatti, Maeda and Ishiguro 2004): the band is averaged to 15 rows, gain and offset are taken out, and of
/// each row the first 15 harmonics along the azimuth are kept. A turn changes their phases only: the distance is that of the
/// magnitudes, L1, as a share of their sum; the heading that at which the phases agree best, over the full turn.
std::unique_ptr<PlaceMethod> fourier_signature();

}  // namespace panvo::evaluation
