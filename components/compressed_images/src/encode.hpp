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

/// The image as a JPEG or PNG file under its own header, `format` as ROS 2's image_transport writes it. JPEG: 8 bits,
/// colour at full resolution (4:4:4) from quality 90 on, at half of it below. PNG keeps every pixel. The reason says what is
/// wrong with the image, or why the file cannot hold it (16 bits in a JPEG).
conversions::Result<std::shared_ptr<const sensor_msgs::msg::CompressedImage>> encode(
    const sensor_msgs::msg::Image& image, const Encoding& encoding);

}  // namespace panvo::compressed_images
