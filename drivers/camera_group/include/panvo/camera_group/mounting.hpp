// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "panvo/camera_group/group_image.hpp"
#include "tf2_msgs/msg/TFMessage.h"

namespace panvo::camera_group {

/// Where cameras sit on the vehicle, as /tf_static has it. `mount`: x, y, z in m, roll, pitch, yaw in degrees of a camera that looks along +x of
/// base_link, for each image; or of the left one of a pair only, whose right one its calibration places; empty: no transforms. Throws
/// std::invalid_argument for another count of numbers.
tf2_msgs::msg::TFMessage mounting(const std::vector<double>& mount, const std::vector<GroupImage>& images,
                                  std::int64_t stamp_ns);

}  // namespace panvo::camera_group
