// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "panvo/conversions/result.hpp"
#include "sensor_msgs/msg/CompressedImage.h"
#include "sensor_msgs/msg/Image.h"

namespace panvo::compressed_images {

enum class Output {
  kSame,   ///< as many channels as the file has
  kMono8,  ///< grey: a third of the bytes of colour, and of JPEG half the work
};

/// The image in a JPEG or PNG file that came as a message, under the message's header. What the file is, its first bytes
/// say; of the message's `format` ("jpeg", "rgb8; jpeg compressed bgr8") only the order of colours is believed.
/// Encodings: mono8, bgr8 or rgb8 (as `format` begins), of PNG also mono16 and bgra8; colours of 16 bits become 8. The
/// picture is not turned by what EXIF says: cameras are calibrated as their sensors lie. The reason says what is wrong
/// with the file: cut off, damaged, of another kind, or larger than 100 million pixels.
conversions::Result<std::shared_ptr<const sensor_msgs::msg::Image>> decode(
    const sensor_msgs::msg::CompressedImage& message, Output output);

}  // namespace panvo::compressed_images
