// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "panvo/conversions/result.hpp"
#include "sensor_msgs/msg/CompressedImage.h"
#include "sensor_msgs/msg/Image.h"

namespace panvo::compressed_images {

enum class Output {
  kSame,   ///< channels as in the file
  kMono8,  ///< grey: a third of the bytes of colour; for JPEG half the decoding time
};

/// Decodes the JPEG or PNG file in a message; the image keeps the message's header. The first bytes determine the file
/// type. The message's `format` ("jpeg", "rgb8; jpeg compressed bgr8") determines only the colour order: rgb8 if it
/// begins with rgb, else bgr8. Encodings: mono8, bgr8 or rgb8, for PNG also mono16 and bgra8; 16-bit colour becomes
/// 8-bit. EXIF rotation is ignored, since calibration refers to the sensor. On failure the result holds the reason:
/// truncated, damaged, another file type, or more than 100 million pixels.
conversions::Result<std::shared_ptr<const sensor_msgs::msg::Image>> decode(
    const sensor_msgs::msg::CompressedImage& message, Output output);

}  // namespace panvo::compressed_images
