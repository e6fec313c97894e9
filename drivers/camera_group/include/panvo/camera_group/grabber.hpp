// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "panvo/camera_group/device_setting.hpp"
#include "panvo/camera_stream/stream_counters.hpp"
#include "sensor_msgs/msg/Image.h"

namespace panvo::camera_group {

/// What a device took at one moment.
struct GrabbedFrame {
  std::int64_t stamp_ns = 0;                                     ///< host time
  std::vector<std::shared_ptr<sensor_msgs::msg::Image>> images;  ///< without stamps: one, or left and right
};

/// One device, kept streaming: opened, set, read, noticed to be gone, and found again, by a thread of its own, until this object ends.
class Grabber {
 public:
  /// Is called on the grabber's thread.
  using OnFrame = std::function<void(GrabbedFrame)>;

  Grabber() = default;
  virtual ~Grabber() = default;
  Grabber(const Grabber&) = delete;
  Grabber& operator=(const Grabber&) = delete;

  /// From any thread.
  virtual camera_stream::StreamReport report() const = 0;

  /// Sets these while the device streams, and from now on whenever it is opened, instead of those before. From any thread; done soon.
  virtual void set(std::vector<DeviceSetting> settings) = 0;
};

/// Makes the grabber of a device and begins to open it.
using StartGrabber = std::function<std::unique_ptr<Grabber>(Grabber::OnFrame)>;

}  // namespace panvo::camera_group
