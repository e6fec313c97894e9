// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "gobject.hpp"
#include "panvo/aravis_camera/camera_settings.hpp"

namespace panvo::aravis_camera {

/// Sets a GenICam feature of whatever type; a command is executed (its value is not used). Returns what is wrong, empty when all is well:
/// "Gain=99: is out of range, 0 to 24".
std::string apply(ArvDevice* device, const camera_group::DeviceSetting& setting);

}  // namespace panvo::aravis_camera
