// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "panvo/aravis_camera/camera_settings.hpp"
#include "panvo/camera_group/grabber.hpp"
#include "panvo/camera_stream/raw_image.hpp"
#include "panvo/runtime/logger.hpp"

namespace panvo::aravis_camera {

/// Where stamps come from.
enum class StampSource {
  kMapped,   ///< the camera's clock, mapped to the host's
  kPtp,      ///< the camera's clock, which follows the same master as the host's
  kArrival,  ///< the host's clock at arrival
};

struct GrabberSettings {
  std::string name;      ///< "left"
  std::string frame_id;  ///< of the images
  CameraSettings camera;
  StampSource stamps = StampSource::kMapped;
  camera_stream::ImageOutput output = camera_stream::ImageOutput::kReadable;
  std::int64_t watchdog_ns = 1'000'000'000;  ///< without a frame for so long, the camera counts as lost; 0: never
};

/// One camera, kept streaming by a thread of its own: opens it, sets it, receives, notices that it is gone, closes it, and finds it again by its
/// serial number. What happens is logged when it begins and counted.
class CameraGrabber final : public camera_group::Grabber {
 public:
  using Frame = camera_group::GrabbedFrame;

  CameraGrabber(GrabberSettings settings, const runtime::Logger& log, OnFrame on_frame);
  /// Ends the thread and closes the camera.
  ~CameraGrabber() override;

  camera_stream::StreamReport report() const override;
  void set(std::vector<camera_group::DeviceSetting> features) override;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace panvo::aravis_camera
