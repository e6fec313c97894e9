// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "panvo/v4l2_camera/camera_settings.hpp"
#include "panvo/v4l2_camera/video_device.hpp"

namespace panvo::v4l2_camera {

/// The requested and the actual settings of a camera.
struct Negotiated {
  ImageFormat asked, given;
  double rate_hz = 0.0;                ///< 0: not known
  std::vector<std::string> refused{};  ///< one message for each refused setting
};

/// Configures a camera (controls, format, rate, buffers) and starts streaming. Refused settings keep their values and
/// are reported; throws DeviceError if no image could be read, or if it does not stream.
Negotiated start(VideoDevice& device, const std::string& node, const CameraSettings& settings);

/// Sets controls immediately; returns one message for each that is refused.
std::vector<std::string> set_controls(VideoDevice& device, const std::vector<camera_group::DeviceSetting>& settings);

}  // namespace panvo::v4l2_camera
