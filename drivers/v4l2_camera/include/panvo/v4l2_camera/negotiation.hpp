// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "panvo/v4l2_camera/camera_settings.hpp"
#include "panvo/v4l2_camera/video_device.hpp"

namespace panvo::v4l2_camera {

/// What a camera was set to in the end.
struct Negotiated {
  ImageFormat asked, given;
  double rate_hz = 0.0;                ///< 0: not known
  std::vector<std::string> refused{};  ///< settings that the camera did not take, and why
};

/// Sets a camera and has it stream: controls, format, rate, buffers. What it refuses is told and left; throws DeviceError where no image could be
/// read, or it does not stream.
Negotiated start(VideoDevice& device, const std::string& node, const CameraSettings& settings);

/// Sets controls now; returns what the camera does not take, and why.
std::vector<std::string> set_controls(VideoDevice& device, const std::vector<camera_group::DeviceSetting>& settings);

}  // namespace panvo::v4l2_camera
