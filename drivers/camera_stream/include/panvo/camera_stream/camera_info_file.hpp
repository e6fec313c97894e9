// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "sensor_msgs/msg/CameraInfo.h"

namespace panvo::camera_stream {

/// A calibration file that cannot be used. what() names file, line, key and what to do.
class CalibrationFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A calibration as ROS's camera_calibration writes it, as the message it is a file of: of any lens model, stamp and frame still to be set.
/// Throws CalibrationFileError.
sensor_msgs::msg::CameraInfo read_camera_info(const std::filesystem::path& file);

/// Why a calibration is not that of images of this size, px; empty: it may be.
std::string size_problem(const sensor_msgs::msg::CameraInfo& info, int width, int height);

}  // namespace panvo::camera_stream
