// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "panvo/simulation/road_network.hpp"
#include "panvo/simulation/route.hpp"

namespace panvo::simulation {

/// The plan of the campus from above, north up: roads, junctions with their names, and the path of a route, which goes
/// from blue at its beginning to red at its end. CV_8UC3, BGR.
cv::Mat plan_picture(const RoadNetwork& roads, const DrivenPath& path);

}  // namespace panvo::simulation
