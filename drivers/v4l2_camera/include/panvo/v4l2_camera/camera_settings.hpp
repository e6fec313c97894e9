// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "panvo/camera_group/device_setting.hpp"
#include "panvo/camera_stream/raw_image.hpp"
#include "panvo/v4l2_camera/format_choice.hpp"
#include "panvo/v4l2_camera/image_parts.hpp"

namespace panvo::v4l2_camera {

/// Where stamps come from.
enum class StampSource : std::uint8_t {
  kDriver,   ///< the kernel's driver: exposure or transfer of the frame, in the host's time
  kArrival,  ///< the host's clock when the frame was taken from its buffer
};

/// How one camera is found, set and read.
struct CameraSettings {
  std::string name;                    ///< "camera", "left": for people
  std::string camera;                  ///< serial number, path, USB port or name; empty: the first that is found
  std::vector<std::string> frame_ids;  ///< of the images that come of each of its frames
  FormatWish format{};
  std::vector<camera_group::DeviceSetting> controls{};  ///< set before it streams, in order
  ImageSplitter::Settings parts{};
  camera_stream::ImageOutput output = camera_stream::ImageOutput::kReadable;
  StampSource stamps = StampSource::kDriver;
  int buffers = 4;
  std::int64_t watchdog_ns = 1'000'000'000;  ///< without a frame for so long, the camera counts as lost; 0: never
};

}  // namespace panvo::v4l2_camera
