// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "sensor_msgs/msg/CameraInfo.h"

namespace panvo::camera_stream {

/// A calibration file that cannot be used. what() names file, line, key and remedy.
class CalibrationFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads a calibration file in the format of ROS's camera_calibration, with any lens model. The header (stamp, frame)
/// is left empty. Throws CalibrationFileError.
sensor_msgs::msg::CameraInfo read_camera_info(const std::filesystem::path& file);

/// Why a calibration does not apply to images of this size in px; empty if the sizes match.
std::string size_problem(const sensor_msgs::msg::CameraInfo& info, int width, int height);

}  // namespace panvo::camera_stream
