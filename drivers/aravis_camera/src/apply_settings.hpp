// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "gobject.hpp"
#include "panvo/aravis_camera/camera_settings.hpp"

namespace panvo::aravis_camera {

/// Sets the camera; what it does not take is left as it is and returned, a sentence each.
std::vector<std::string> apply(ArvCamera* camera, const CameraSettings& settings);

/// The same for features alone.
std::vector<std::string> apply(ArvCamera* camera, const std::vector<camera_group::DeviceSetting>& features);

}  // namespace panvo::aravis_camera
