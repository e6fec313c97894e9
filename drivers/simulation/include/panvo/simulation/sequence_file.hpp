// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "panvo/simulation/simulation.hpp"

namespace panvo::simulation {

/// What is true of a journey, as YAML: route, effects, junctions, visits, revisits with their entrance angles, clouds,
/// movers and zones of weak texture. Angles in degrees, counter-clockwise, 0 = +x of the world; times as in the images'
/// stamps, ns; lengths in m.
std::string sequence_yaml(const Simulation& simulation);

}  // namespace panvo::simulation
