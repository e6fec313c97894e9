// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "panvo/evaluation/journey_evaluation.hpp"

namespace panvo::evaluation {

/// A self-contained HTML report: key figures, trajectories, error over distance, tables, each revisit with both
/// panoramas, states, times, and run settings. Deterministic. Throws InputError for a panorama that cannot be decoded.
std::string journey_page(const JourneyReport& report);

}  // namespace panvo::evaluation
