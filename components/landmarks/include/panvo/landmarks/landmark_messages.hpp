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

/// Conversions of landmarks to and from messages, for the topic `landmarks`.
namespace panvo::landmarks {

/// Exact except for the rounding of rotations to quaternions. `settings`: those the landmark was described with;
/// `map_frame`: frame of its pose, "map".
panvo_msgs::msg::PanoramicLandmark to_message(const PanoramicLandmark& landmark, const DescriptionSettings& settings,
                                              const std::string& map_frame);

/// The reason states why the message cannot be used: it was described with other settings than `settings` (lists each
/// key that differs with both values), or the result of interfaces::problem_of().
conversions::Result<PanoramicLandmark> to_landmark(const panvo_msgs::msg::PanoramicLandmark& message,
                                                   const DescriptionSettings& settings);

/// Keypoints alone, as sent between robots; the receiver's message has been checked by its rules.
std::vector<panvo_msgs::msg::LandmarkKeypoint> to_keypoint_messages(const std::vector<Keypoint>& keypoints);
std::vector<Keypoint> to_keypoints(const std::vector<panvo_msgs::msg::LandmarkKeypoint>& messages);

/// Optimised landmark poses. The reason is the result of interfaces::problem_of().
conversions::Result<std::vector<LandmarkPose>> to_landmark_poses(const panvo_msgs::msg::LandmarkPoses& message);

}  // namespace panvo::landmarks
