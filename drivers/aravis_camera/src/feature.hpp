// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "gobject.hpp"
#include "panvo/aravis_camera/camera_settings.hpp"

namespace panvo::aravis_camera {

/// Sets a GenICam feature of any type; commands are executed, and their value is ignored. Returns an error, or an empty
/// string on success: "Gain=99: is out of range, 0 to 24".
std::string apply(ArvDevice* device, const camera_group::DeviceSetting& setting);

}  // namespace panvo::aravis_camera
