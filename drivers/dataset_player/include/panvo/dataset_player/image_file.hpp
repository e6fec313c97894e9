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

/// Decodes image files of all formats of OpenCV to 8-bit grey or BGR. Reuses its read buffer.
class ImageDecoder {
 public:
  /// Decodes `file` into a newly allocated `image`. On failure `image` is empty and the return value describes the
  /// fault, else nullopt. A truncated JPEG is a failure.
  std::optional<std::string> decode(const std::filesystem::path& file, Colour colour, cv::Mat& image);

 private:
  std::vector<std::uint8_t> bytes_;
};

/// An image of a folder and the number at the end of its name ("left12.jpg": 12).
struct ImageFile {
  std::filesystem::path path;
  std::optional<std::uint64_t> number;
};

/// Lists the files of a folder with image extensions, ordered by number (2 before 10), then by name.
std::vector<ImageFile> list_images(const std::filesystem::path& folder);

}  // namespace panvo::dataset_player
