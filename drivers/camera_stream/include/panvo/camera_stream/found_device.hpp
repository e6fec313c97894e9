// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace panvo::camera_stream {

/// A camera that is connected, for people who choose one.
struct FoundDevice {
  std::string driver;    ///< component that drives it: "aravis_camera"
  std::string protocol;  ///< "GigEVision", "USB3Vision", "UVC"
  std::string vendor, model, serial;
  std::string address;               ///< IP address, USB path or device node
  std::vector<std::string> formats;  ///< by the camera's names
  std::string sizes;                 ///< "640 x 480, up to 2048 x 2048 px"
  std::string rates;                 ///< "1 to 60 Hz"
  std::string problem;               ///< why no more is known: busy, no permission; empty: all is
};

/// Some lines a camera, the first of them what to write into a system file.
std::string to_text(const std::vector<FoundDevice>& devices);

/// A list of objects, for scripts.
std::string to_json(const std::vector<FoundDevice>& devices);

}  // namespace panvo::camera_stream
