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

/// Source of the image stamps.
enum class StampSource {
  kMapped,   ///< camera clock, mapped to the host clock
  kPtp,      ///< camera clock, synchronised to the same PTP master as the host
  kArrival,  ///< host clock at arrival
};

struct GrabberSettings {
  std::string name;      ///< "left"
  std::string frame_id;  ///< of the images
  CameraSettings camera;
  StampSource stamps = StampSource::kMapped;
  camera_stream::ImageOutput output = camera_stream::ImageOutput::kReadable;
  std::int64_t watchdog_ns = 1'000'000'000;  ///< the camera counts as lost after this time without a frame; 0: never
};

/// Keeps one camera streaming on its own thread: opens and configures it, receives frames, detects its loss, and finds
/// it again by serial number. Faults are logged when they start, and counted.
class CameraGrabber final : public camera_group::Grabber {
 public:
  using Frame = camera_group::GrabbedFrame;

  CameraGrabber(GrabberSettings settings, const runtime::Logger& log, OnFrame on_frame);
  /// Stops the thread and closes the camera.
  ~CameraGrabber() override;

  camera_stream::StreamReport report() const override;
  void set(std::vector<camera_group::DeviceSetting> features) override;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace panvo::aravis_camera
