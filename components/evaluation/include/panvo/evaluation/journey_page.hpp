// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "panvo/evaluation/journey_evaluation.hpp"

namespace panvo::evaluation {

/// The journey as one page for a browser that needs nothing beside itself: figures, paths, error over distance, tables, each
/// revisit with both panoramas, states, times, and what was run. The same text for the same report. Throws InputError for a
/// panorama that cannot be decoded.
std::string journey_page(const JourneyReport& report);

}  // namespace panvo::evaluation
