// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "panvo/panoramic_compass/panoramic_compass.hpp"
#include "panvo_msgs/msg/PanoramaPoints.h"

namespace panvo::panoramic_compass {

/// `points`: nullptr if the panorama shows no motion.
panvo_msgs::msg::PanoramaPoints to_message(std::int64_t stamp_ns, const TrackedPoints* points,
                                           const std::string& frame);

}  // namespace panvo::panoramic_compass
