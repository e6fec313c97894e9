// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "gobject.hpp"
#include "panvo/aravis_camera/camera_settings.hpp"

namespace panvo::aravis_camera {

/// Configures the camera. Settings that it refuses keep their values; returns one message for each.
std::vector<std::string> apply(ArvCamera* camera, const CameraSettings& settings);

/// Sets only features; returns one message for each that is refused.
std::vector<std::string> apply(ArvCamera* camera, const std::vector<camera_group::DeviceSetting>& features);

}  // namespace panvo::aravis_camera
