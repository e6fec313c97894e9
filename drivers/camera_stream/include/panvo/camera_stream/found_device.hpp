// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace panvo::camera_stream {

/// A connected camera, as listed for the user.
struct FoundDevice {
  std::string driver;    ///< component that drives it: "aravis_camera"
  std::string protocol;  ///< "GigEVision", "USB3Vision", "UVC"
  std::string vendor, model, serial;
  std::string address;               ///< IP address, USB path or device node
  std::vector<std::string> formats;  ///< names used by the camera
  std::string sizes;                 ///< "640 x 480, up to 2048 x 2048 px"
  std::string rates;                 ///< "1 to 60 Hz"
  std::string problem;               ///< why details are missing: busy, no permission; empty: none
};

/// Several lines per camera; the first starts with the serial number to write into a system file.
std::string to_text(const std::vector<FoundDevice>& devices);

/// A JSON list of objects, for scripts.
std::string to_json(const std::vector<FoundDevice>& devices);

}  // namespace panvo::camera_stream
