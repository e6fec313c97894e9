// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "panvo/conversions/result.hpp"
#include "sensor_msgs/msg/Image.h"

namespace panvo::camera_stream {

/// Pixel formats of cameras, with the names of the GenICam Pixel Format Naming Convention; kYuyv and kUyvy are its
/// YUV422_8 and YUV422_8_UYVY.
enum class PixelFormat : std::uint8_t {
  kMono8,
  kMono10,
  kMono12,
  kMono14,
  kMono16,
  kMono10p,       ///< 4 px in 5 bytes, lowest bit first
  kMono12p,       ///< 2 px in 3 bytes, lowest bit first
  kMono10Packed,  ///< 2 px in 3 bytes, the low bits of both in the middle byte (GigE Vision 1)
  kMono12Packed,
  kBayerRG8,
  kBayerGR8,
  kBayerGB8,
  kBayerBG8,
  kRgb8,
  kBgr8,
  kYuyv,
  kUyvy,
};

std::string_view name_of(PixelFormat format);

/// Encoding of the published images.
enum class ImageOutput : std::uint8_t {
  kReadable,  ///< readable by every component: mono8, mono16 and rgb8 unchanged, Bayer patterns and YUV as bgr8
  kGrey,      ///< mono8
  kAsSent,    ///< the ROS encoding of the camera's format: bayer_rggb8, yuv422, ...; packed pixels are unpacked
};

/// An image in a driver's buffer.
struct RawImage {
  PixelFormat format = PixelFormat::kMono8;
  int width = 0, height = 0;  ///< px
  std::size_t step = 0;       ///< bytes from one row to the next; 0: rows without gaps. Packed formats have none.
  std::span<const std::uint8_t> bytes{};
};

/// The image as a message without a stamp. Grey of 10 to 14 bits is shifted up to the full range of mono16. Fails with
/// a reason if the size or the number of bytes is wrong.
conversions::Result<std::shared_ptr<sensor_msgs::msg::Image>> to_image(const RawImage& raw, ImageOutput output,
                                                                       const std::string& frame_id);

}  // namespace panvo::camera_stream
