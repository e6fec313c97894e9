// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "panvo/camera_group/group_image.hpp"
#include "tf2_msgs/msg/TFMessage.h"

namespace panvo::camera_group {

/// Transforms from base_link to the optical frames, for /tf_static. `mount`: x, y, z in m and roll, pitch, yaw in
/// degrees for each image, relative to a camera that looks along +x of base_link. For a pair, the left camera's six
/// numbers suffice; the right one is then placed by the calibrations. Empty: no transforms. Throws
/// std::invalid_argument for any other number of values.
tf2_msgs::msg::TFMessage mounting(const std::vector<double>& mount, const std::vector<GroupImage>& images,
                                  std::int64_t stamp_ns);

}  // namespace panvo::camera_group
