// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "camera_group.hpp"
#include "tf2_msgs/msg/TFMessage.h"

namespace panvo::aravis_camera {

/// Where the cameras sit on the vehicle. `mount`: six numbers for each camera (x, y, z in m, roll, pitch, yaw in degrees, of a camera that looks along
/// +x of base_link), or six for the left one of a stereo pair, whose right one is then placed by the calibration. Throws SettingsError.
tf2_msgs::msg::TFMessage mounting(const std::vector<double>& mount, const std::vector<CameraOfGroup>& cameras,
                                  std::int64_t stamp_ns);

}  // namespace panvo::aravis_camera
