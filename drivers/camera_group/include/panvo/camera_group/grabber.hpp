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

/// The images that a device took at one time.
struct GrabbedFrame {
  std::int64_t stamp_ns = 0;                                     ///< host time
  std::vector<std::shared_ptr<sensor_msgs::msg::Image>> images;  ///< without stamps: one, or left and right
};

/// Keeps one device streaming, on its own thread, until this object is destroyed: opens and configures it, reads
/// frames, detects its loss and reconnects.
class Grabber {
 public:
  /// Called on the grabber's thread.
  using OnFrame = std::function<void(GrabbedFrame)>;

  Grabber() = default;
  virtual ~Grabber() = default;
  Grabber(const Grabber&) = delete;
  Grabber& operator=(const Grabber&) = delete;

  /// Thread-safe.
  virtual camera_stream::StreamReport report() const = 0;

  /// Replaces the settings: they are applied soon if the device streams, and each time it is opened. Thread-safe.
  virtual void set(std::vector<DeviceSetting> settings) = 0;
};

/// Creates the grabber of a device, which starts opening it.
using StartGrabber = std::function<std::unique_ptr<Grabber>(Grabber::OnFrame)>;

}  // namespace panvo::camera_group
