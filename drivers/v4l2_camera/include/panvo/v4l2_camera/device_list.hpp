// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "panvo/camera_stream/found_device.hpp"
#include "panvo/v4l2_camera/camera_grabber.hpp"

namespace panvo::v4l2_camera {

/// Lists the connected V4L2 cameras. Opens each briefly to read its formats, sizes and rates; one that cannot be opened
/// is listed with the reason.
std::vector<camera_stream::FoundDevice> find_devices(const Devices& devices = {});

}  // namespace panvo::v4l2_camera
