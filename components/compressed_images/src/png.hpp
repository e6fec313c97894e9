// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "panvo/conversions/result.hpp"

/// PNG coding: libpng for reading, OpenCV for writing.
namespace panvo::compressed_images::png {

struct Header {
  std::uint32_t width = 0, height = 0;
};

bool is_png(std::span<const std::uint8_t> file);
/// Reads only the size from the file's first bytes.
conversions::Result<Header> read_header(std::span<const std::uint8_t> file);

/// Decodes to 8 bits in 1, 3 or 4 channels (BGR order) or 16 bits in one; 16-bit colour becomes 8-bit.
conversions::Result<cv::Mat> decode(std::span<const std::uint8_t> file);

/// Encodes 8 or 16 bits in 1, 3 or 4 channels, BGR order.
std::vector<std::uint8_t> encode(const cv::Mat& pixels, int level);

}  // namespace panvo::compressed_images::png
