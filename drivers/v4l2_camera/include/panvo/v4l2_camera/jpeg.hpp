// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "panvo/camera_stream/raw_image.hpp"
#include "panvo/conversions/result.hpp"

namespace panvo::v4l2_camera {

/// Decodes the frames of MJPG streams with libjpeg-turbo; all frames use the same memory.
class JpegDecoder {
 public:
  /// Returns Mono8 or Bgr8 pixels, valid until the next call; grey files give Mono8. Fails with a reason: not a JPEG
  /// file, size differs from the stream, damaged or truncated. Padding before or after the end marker is accepted;
  /// missing Huffman tables are replaced by the standard ones.
  conversions::Result<camera_stream::RawImage> decode(std::span<const std::uint8_t> file, int width, int height,
                                                      bool as_grey);

 private:
  std::vector<std::uint8_t> pixels_;
};

}  // namespace panvo::v4l2_camera
