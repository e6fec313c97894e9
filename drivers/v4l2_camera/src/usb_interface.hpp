// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace panvo::v4l2_camera {

/// The sysfs folder of the USB interface of a video node; empty: not a USB device. `node`: the node's folder in sysfs.
inline std::filesystem::path usb_interface(const std::filesystem::path& node) {
  std::error_code error;
  const auto interface = std::filesystem::canonical(node / "device", error);
  if (error || !std::filesystem::exists(interface / "bInterfaceNumber", error)) return {};
  return interface;
}

}  // namespace panvo::v4l2_camera
