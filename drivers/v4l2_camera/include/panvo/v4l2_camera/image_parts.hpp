// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "panvo/camera_stream/raw_image.hpp"
#include "panvo/conversions/result.hpp"

namespace panvo::v4l2_camera {

/// How the images of several cameras share one.
enum class ImageParts : std::uint8_t {
  kOne,              ///< they do not
  kSideBySide,       ///< left half, right half
  kTopBottom,        ///< upper half, lower half
  kByteInterleaved,  ///< of each pixel of two bytes one is of the one eye, one of the other (Bumblebee2, Format7 mode 3)
};

/// Takes an image apart. Halves are views of it; only interleaved bytes are copied, into memory that is used again with the next image.
class ImageSplitter {
 public:
  struct Settings {
    ImageParts parts = ImageParts::kOne;
    bool swap = false;                                                            ///< the right eye's part comes first
    camera_stream::PixelFormat interleaved = camera_stream::PixelFormat::kMono8;  ///< what each byte is
  };

  explicit ImageSplitter(const Settings& settings) : settings_(settings) {}

  /// One image, or left and right; valid until the next call and as long as `whole`'s bytes. The reason says what does not divide.
  conversions::Result<std::vector<camera_stream::RawImage>> split(const camera_stream::RawImage& whole);

 private:
  conversions::Result<std::vector<camera_stream::RawImage>> side_by_side(const camera_stream::RawImage& whole) const;
  conversions::Result<std::vector<camera_stream::RawImage>> top_bottom(const camera_stream::RawImage& whole) const;
  conversions::Result<std::vector<camera_stream::RawImage>> byte_interleaved(const camera_stream::RawImage& whole);

  Settings settings_;
  std::vector<std::uint8_t> first_, second_;
};

}  // namespace panvo::v4l2_camera
