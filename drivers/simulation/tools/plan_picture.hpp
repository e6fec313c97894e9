// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "panvo/simulated_world/road_network.hpp"
#include "panvo/simulation/route.hpp"

namespace panvo::simulation {

/// Draws a map of the campus, north up: roads, junctions with their names, and the path of a route, coloured from blue
/// at its start to red at its end. CV_8UC3, BGR.
cv::Mat plan_picture(const simulated_world::RoadNetwork& roads, const DrivenPath& path);

}  // namespace panvo::simulation
