// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "panvo/simulation/simulation.hpp"

namespace panvo::simulation {

/// The ground truth of a journey as YAML: route, effects, junctions, visits, revisits with entrance angles, clouds,
/// movers and zones of weak texture. Angles in degrees, counter-clockwise, 0 = +x of the world; times in ns as image
/// stamps; lengths in m.
std::string sequence_yaml(const Simulation& simulation);

}  // namespace panvo::simulation
