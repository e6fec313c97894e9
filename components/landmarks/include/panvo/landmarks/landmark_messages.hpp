// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "panvo/conversions/result.hpp"
#include "panvo/landmarks/description_settings.hpp"
#include "panvo/landmarks/landmark_store.hpp"
#include "panvo/landmarks/panoramic_landmark.hpp"
#include "panvo_msgs/msg/LandmarkPoses.h"
#include "panvo_msgs/msg/PanoramicLandmark.h"

/// Landmarks as messages, for the topic `landmarks`.
namespace panvo::landmarks {

/// Exact but for the rounding of rotations to quaternions. `settings`: what it was described with; `map_frame`: the frame of
/// its pose, "map".
panvo_msgs::msg::PanoramicLandmark to_message(const PanoramicLandmark& landmark, const DescriptionSettings& settings,
                                              const std::string& map_frame);

/// The reason says what cannot be used: it was described with other settings than `settings` (each key that differs, with
/// both values), or what interfaces::problem_of() says.
conversions::Result<PanoramicLandmark> to_landmark(const panvo_msgs::msg::PanoramicLandmark& message,
                                                   const DescriptionSettings& settings);

/// Where landmarks are known to be by now. The reason is what interfaces::problem_of() says.
conversions::Result<std::vector<LandmarkPose>> to_landmark_poses(const panvo_msgs::msg::LandmarkPoses& message);

}  // namespace panvo::landmarks
