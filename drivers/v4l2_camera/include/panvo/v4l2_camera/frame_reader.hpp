// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "panvo/v4l2_camera/camera_settings.hpp"
#include "panvo/v4l2_camera/jpeg.hpp"
#include "panvo/v4l2_camera/video_device.hpp"
#include "sensor_msgs/msg/Image.h"

namespace panvo::v4l2_camera {

/// The result of reading a frame.
struct ReadFrame {
  enum class Outcome : std::uint8_t { kWhole, kIncomplete, kDamaged };
  Outcome outcome = Outcome::kWhole;
  std::string problem{};                                           ///< if incomplete or damaged
  std::vector<std::shared_ptr<sensor_msgs::msg::Image>> images{};  ///< without stamps: one, or left and right
};

/// Turns the bytes of a camera's buffers into images: decodes, splits and converts them.
class FrameReader {
 public:
  FrameReader(const CameraSettings& settings, const ImageFormat& format);

  ReadFrame read(const BufferedFrame& frame);

 private:
  std::vector<std::string> frame_ids_;
  camera_stream::ImageOutput output_;
  ImageFormat format_;
  JpegDecoder jpeg_;
  ImageSplitter splitter_;
};

}  // namespace panvo::v4l2_camera
