// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "made_up_landmark.hpp"
#include "panvo/landmarks/landmark_messages.hpp"
#include "panvo_msgs/msg/LandmarkPoses.h"

namespace panvo::landmarks::test {

/// The poses of landmarks, as the localizer publishes them.
inline panvo_msgs::msg::LandmarkPoses to_poses_message(const std::vector<PanoramicLandmark>& landmarks) {
  panvo_msgs::msg::LandmarkPoses message;
  for (const auto& landmark : landmarks) {
    message.ids().push_back(landmark.id);
    message.poses().push_back(to_message(landmark, made_up_settings(), "map").pose());
  }
  return message;
}

}  // namespace panvo::landmarks::test
