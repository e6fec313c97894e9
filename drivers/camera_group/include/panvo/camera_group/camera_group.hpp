// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "panvo/camera_group/grabber.hpp"
#include "panvo/camera_group/group_image.hpp"
#include "panvo/runtime/context.hpp"

namespace panvo::camera_group {

/// Cameras that belong together: each grabbed on its own, brought together by stamp, published under one stamp, and reported to diagnostics.
class CameraGroup {
 public:
  struct Description {
    std::vector<StartGrabber> devices;
    std::vector<GroupImage> images;  ///< of each device one, in their order, or all of the only device
    std::int64_t tolerance_ns = 0;   ///< between the stamps of images that belong together
  };

  CameraGroup(runtime::Context& context, Description description);
  /// Closes the cameras.
  ~CameraGroup();
  CameraGroup(const CameraGroup&) = delete;
  CameraGroup& operator=(const CameraGroup&) = delete;

  /// Begins to open the cameras. What they send is published from now on.
  void start();

  /// Of each device, in order; see Grabber::set; before start() or after it, from any thread.
  void set(std::vector<std::vector<DeviceSetting>> settings);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace panvo::camera_group
