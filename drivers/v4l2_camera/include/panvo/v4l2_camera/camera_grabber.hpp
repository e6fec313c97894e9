// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "panvo/camera_stream/stream_counters.hpp"
#include "panvo/runtime/logger.hpp"
#include "panvo/v4l2_camera/camera_settings.hpp"
#include "panvo/v4l2_camera/video_device.hpp"
#include "panvo/v4l2_camera/video_node.hpp"
#include "sensor_msgs/msg/Image.h"

namespace panvo::v4l2_camera {

/// How cameras are found and opened.
struct Devices {
  std::function<std::vector<VideoNode>()> list = [] { return list_nodes(); };
  std::function<std::unique_ptr<VideoDevice>(const std::string& node)> open = open_video_device;
};

/// One camera, kept streaming by a thread of its own: finds it, sets it, receives, notices that it is gone, and finds it again by its serial number.
/// What happens is logged when it begins and counted.
class CameraGrabber {
 public:
  struct Frame {
    std::int64_t stamp_ns = 0;                                     ///< host time
    std::vector<std::shared_ptr<sensor_msgs::msg::Image>> images;  ///< without stamps: one, or left and right
  };
  using OnFrame = std::function<void(Frame)>;

  /// `on_frame` is called on the grabber's thread.
  CameraGrabber(CameraSettings settings, const runtime::Logger& log, OnFrame on_frame, Devices devices = {});
  /// Ends the thread and closes the camera.
  ~CameraGrabber();
  CameraGrabber(const CameraGrabber&) = delete;
  CameraGrabber& operator=(const CameraGrabber&) = delete;

  /// From any thread.
  camera_stream::StreamReport report() const;

  /// Sets controls while the camera streams, and from now on whenever it is opened, instead of those before. From any thread; done soon.
  void set_controls(std::vector<ControlSetting> controls);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace panvo::v4l2_camera
