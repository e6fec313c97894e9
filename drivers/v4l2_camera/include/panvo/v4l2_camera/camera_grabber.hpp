// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "panvo/camera_group/grabber.hpp"
#include "panvo/runtime/logger.hpp"
#include "panvo/v4l2_camera/camera_settings.hpp"
#include "panvo/v4l2_camera/video_device.hpp"
#include "panvo/v4l2_camera/video_node.hpp"

namespace panvo::v4l2_camera {

/// Functions that list and open cameras; replaceable for tests.
struct Devices {
  std::function<std::vector<VideoNode>()> list = [] { return list_nodes(); };
  std::function<std::unique_ptr<VideoDevice>(const std::string& node)> open = open_video_device;
};

/// Keeps one camera streaming on its own thread: finds and configures it, receives frames, detects its loss, and finds
/// it again by serial number. Faults are logged when they start, and counted.
class CameraGrabber final : public camera_group::Grabber {
 public:
  using Frame = camera_group::GrabbedFrame;

  CameraGrabber(CameraSettings settings, const runtime::Logger& log, OnFrame on_frame, Devices devices = {});
  /// Stops the thread and closes the camera.
  ~CameraGrabber() override;

  camera_stream::StreamReport report() const override;
  void set(std::vector<camera_group::DeviceSetting> controls) override;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace panvo::v4l2_camera
