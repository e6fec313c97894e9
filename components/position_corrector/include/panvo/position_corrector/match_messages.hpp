// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "panvo/position_corrector/landmark_matcher.hpp"
#include "panvo_msgs/msg/LandmarkMatch.h"

namespace panvo::position_corrector {

panvo_msgs::msg::LandmarkMatch to_message(const LandmarkMatch& match, const std::string& panorama_frame);

}  // namespace panvo::position_corrector
