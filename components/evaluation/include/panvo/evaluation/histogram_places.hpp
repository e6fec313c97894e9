// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "panvo/evaluation/place_method.hpp"
#include "panvo/landmarks/panorama_describer.hpp"

namespace panvo::evaluation {

/// The first level of a landmark's description alone: its intensity histogram H [Lu2015 4.2]. Invariant to heading, so
/// it does not estimate one.
std::unique_ptr<PlaceMethod> histogram_places(const landmarks::DescriptionParameters& parameters);

}  // namespace panvo::evaluation
