// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "panvo/camera_stream/raw_image.hpp"
#include "panvo/conversions/result.hpp"

namespace panvo::v4l2_camera {

/// How one image contains those of several cameras.
enum class ImageParts : std::uint8_t {
  kOne,              ///< a single camera
  kSideBySide,       ///< left half, right half
  kTopBottom,        ///< upper half, lower half
  kByteInterleaved,  ///< two-byte pixels with one byte per eye (Bumblebee2, Format7 mode 3)
};

/// Splits an image. Halves are views of it; interleaved bytes are copied into a buffer that is reused for the next
/// image.
class ImageSplitter {
 public:
  struct Settings {
    ImageParts parts = ImageParts::kOne;
    bool swap = false;                                                            ///< the right eye comes first
    camera_stream::PixelFormat interleaved = camera_stream::PixelFormat::kMono8;  ///< format of each byte
  };

  explicit ImageSplitter(const Settings& settings) : settings_(settings) {}

  /// Returns one image, or left and right; valid until the next call and as long as `whole`'s bytes. Fails with a
  /// reason if the image cannot be split.
  conversions::Result<std::vector<camera_stream::RawImage>> split(const camera_stream::RawImage& whole);

 private:
  conversions::Result<std::vector<camera_stream::RawImage>> side_by_side(const camera_stream::RawImage& whole) const;
  conversions::Result<std::vector<camera_stream::RawImage>> top_bottom(const camera_stream::RawImage& whole) const;
  conversions::Result<std::vector<camera_stream::RawImage>> byte_interleaved(const camera_stream::RawImage& whole);

  Settings settings_;
  std::vector<std::uint8_t> first_, second_;
};

}  // namespace panvo::v4l2_camera
