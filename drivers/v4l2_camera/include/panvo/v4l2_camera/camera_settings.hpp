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

/// Source of the image stamps.
enum class StampSource : std::uint8_t {
  kDriver,   ///< kernel driver: exposure or transfer of the frame, in host time
  kArrival,  ///< host clock when the frame is taken from its buffer
};

/// How one camera is found, configured and read.
struct CameraSettings {
  std::string name;                    ///< "camera", "left": for messages
  std::string camera;                  ///< serial number, path, USB port or name; empty: the first camera found
  std::vector<std::string> frame_ids;  ///< of the images made from each of its frames
  FormatWish format{};
  std::vector<camera_group::DeviceSetting> controls{};  ///< set in order before streaming starts
  ImageSplitter::Settings parts{};
  camera_stream::ImageOutput output = camera_stream::ImageOutput::kReadable;
  StampSource stamps = StampSource::kDriver;
  int buffers = 4;
  std::int64_t watchdog_ns = 1'000'000'000;  ///< the camera counts as lost after this time without a frame; 0: never
};

}  // namespace panvo::v4l2_camera
