// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "panvo/position_corrector/position_correction.hpp"
#include "panvo_msgs/msg/PositionCorrection.h"

namespace panvo::position_corrector {

panvo_msgs::msg::PositionCorrection to_message(const PositionCorrection& correction, const std::string& panorama_frame);

}  // namespace panvo::position_corrector
