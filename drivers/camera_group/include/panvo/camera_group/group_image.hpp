// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "panvo/camera_stream/camera_role.hpp"
#include "sensor_msgs/msg/CameraInfo.h"

namespace panvo::camera_group {

/// An image that a group of cameras publishes.
struct GroupImage {
  camera_stream::CameraRole role;
  std::optional<sensor_msgs::msg::CameraInfo> calibration;
};

/// The images of these roles, each with the calibration ROLE.yaml of the folder; without calibrations if
/// `calibration_folder` is empty. Errors of unusable files are appended to `problems`.
std::vector<GroupImage> images_of(const std::vector<camera_stream::CameraRole>& roles,
                                  const std::string& calibration_folder, std::vector<std::string>& problems);

}  // namespace panvo::camera_group
