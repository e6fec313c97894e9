// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "panvo/camera_group/grabber.hpp"
#include "panvo/camera_group/group_image.hpp"
#include "panvo/runtime/context.hpp"

namespace panvo::camera_group {

/// A group of cameras, each with its own grabber. Frames are grouped by stamp and published with one stamp; diagnostics
/// are published every second.
class CameraGroup {
 public:
  struct Description {
    std::vector<StartGrabber> devices;
    std::vector<GroupImage> images;  ///< one per device, in their order; or all images of a single device
    std::int64_t tolerance_ns = 0;   ///< largest stamp difference within a set
  };

  CameraGroup(runtime::Context& context, Description description);
  /// Closes the cameras.
  ~CameraGroup();
  CameraGroup(const CameraGroup&) = delete;
  CameraGroup& operator=(const CameraGroup&) = delete;

  /// Starts opening the cameras and publishing their images.
  void start();

  /// Changes the settings of all devices, in their order; see Grabber::set. Before or after start(), from any thread.
  void set(std::vector<std::vector<DeviceSetting>> settings);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace panvo::camera_group
