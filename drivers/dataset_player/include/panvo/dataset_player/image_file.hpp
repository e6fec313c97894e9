// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

namespace panvo::dataset_player {

enum class Colour { kAsStored, kGrey };

/// Decodes image files (whatever OpenCV reads) to 8-bit grey or BGR. Keeps its read buffer from one file to the next.
class ImageDecoder {
 public:
  /// Decodes `file` into `image`, newly allocated. On failure `image` is empty and the answer says what is wrong with
  /// the file; a JPEG that was cut off counts as failure.
  std::optional<std::string> decode(const std::filesystem::path& file, Colour colour, cv::Mat& image);

 private:
  std::vector<std::uint8_t> bytes_;
};

/// An image of a folder; the number is that which its name ends in ("left12.jpg": 12).
struct ImageFile {
  std::filesystem::path path;
  std::optional<std::uint64_t> number;
};

/// The images of a folder by the extension of their names, in order of number (2 before 10), then of name.
std::vector<ImageFile> list_images(const std::filesystem::path& folder);

}  // namespace panvo::dataset_player
