// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "panvo_msgs/msg/LandmarkMatch.h"
#include "panvo_msgs/msg/PanoramicLandmark.h"

namespace panvo::runner {

/// "stamp_ns,id,is_junction,x,y,z,qx,qy,qz,qw,sigma_x_m,sigma_y_m,keypoints,points"
std::string landmark_header();
/// One line per published landmark message; nullopt if a number is not finite.
std::optional<std::string> landmark_line(const panvo_msgs::msg::PanoramicLandmark& landmark);

/// "stamp_ns,state,landmark_id,heading_deg,histogram_distance,large_distance,small_distance,candidates,..,reason"
std::string match_header();
/// Distances that were not computed are empty; the reason is quoted.
std::optional<std::string> match_line(const panvo_msgs::msg::LandmarkMatch& match);

}  // namespace panvo::runner
