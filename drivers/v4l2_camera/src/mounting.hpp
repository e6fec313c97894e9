// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "camera_group.hpp"
#include "tf2_msgs/msg/TFMessage.h"

namespace panvo::v4l2_camera {

/// Where cameras sit on the vehicle. `mount`: x, y, z in m, roll, pitch, yaw in degrees of a camera that looks along +x of base_link, for each image;
/// or of the left one of a pair only, whose right one its calibration places. Throws runtime::ConfigError.
tf2_msgs::msg::TFMessage mounting(const std::vector<double>& mount, const std::vector<ImageDescription>& images,
                                  std::int64_t stamp_ns);

}  // namespace panvo::v4l2_camera
