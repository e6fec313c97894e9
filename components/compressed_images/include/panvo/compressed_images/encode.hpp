// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "panvo/conversions/result.hpp"
#include "sensor_msgs/msg/CompressedImage.h"
#include "sensor_msgs/msg/Image.h"

namespace panvo::compressed_images {

struct Encoding {
  enum class Kind { kJpeg, kPng } kind = Kind::kJpeg;
  int jpeg_quality = 95;  ///< 1..100
  int png_level = 1;      ///< 0..9: higher is smaller and slower
};

/// Encodes the image as JPEG or PNG with the same header and with `format` as in ROS 2's image_transport. JPEG: 8 bits,
/// colour at full resolution (4:4:4) from quality 90, at half resolution below. PNG is lossless. On failure the result
/// holds the reason: an invalid image, or 16 bits for JPEG.
conversions::Result<std::shared_ptr<const sensor_msgs::msg::CompressedImage>> encode(
    const sensor_msgs::msg::Image& image, const Encoding& encoding);

}  // namespace panvo::compressed_images
