// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "panvo/calibration_files/file_error.hpp"
#include "sensor_msgs/msg/CameraInfo.h"

namespace panvo::camera_stream {

/// Reads a calibration file in the format of ROS's camera_calibration, with any lens model. The header (stamp, frame)
/// is left empty. Throws calibration_files::FileError with all problems.
sensor_msgs::msg::CameraInfo read_camera_info(const std::filesystem::path& file);

/// Why a calibration does not apply to images of this size in px; empty if the sizes match.
std::string size_problem(const sensor_msgs::msg::CameraInfo& info, int width, int height);

}  // namespace panvo::camera_stream
