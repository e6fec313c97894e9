// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "panvo/camera_stream/raw_image.hpp"
#include "panvo/conversions/result.hpp"

namespace panvo::v4l2_camera {

/// Reads the frames of MJPG streams with libjpeg-turbo, one after the other into the same memory.
class JpegDecoder {
 public:
  /// Mono8 or Bgr8 pixels, valid until the next call; grey files give grey. The reason says what is damaged: no JPEG file, of another size than the
  /// stream, cut off. Padding that cameras put before or after the end marker is no damage; left-out Huffman tables are the standard's.
  conversions::Result<camera_stream::RawImage> decode(std::span<const std::uint8_t> file, int width, int height,
                                                      bool as_grey);

 private:
  std::vector<std::uint8_t> pixels_;
};

}  // namespace panvo::v4l2_camera
