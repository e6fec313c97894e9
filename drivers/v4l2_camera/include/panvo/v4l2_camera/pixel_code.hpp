// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "panvo/camera_stream/raw_image.hpp"

namespace panvo::v4l2_camera {

/// A V4L2 pixel format code: four characters, the first in the lowest byte.
using PixelCode = std::uint32_t;

constexpr PixelCode pixel_code(char a, char b, char c, char d) {
  const auto byte = [](char character) { return PixelCode{static_cast<std::uint8_t>(character)}; };
  return byte(a) | byte(b) << 8U | byte(c) << 16U | byte(d) << 24U;
}

inline constexpr PixelCode kMjpg = pixel_code('M', 'J', 'P', 'G');

/// "YUYV", "Y16"; unprintable characters become dots.
std::string to_text(PixelCode code);

/// Parses a code of one to four characters in upper or lower case, padded with spaces: "y16". nullopt: not a code.
std::optional<PixelCode> parse_pixel_code(std::string_view text);

/// How this driver treats a pixel format.
enum class Coding : std::uint8_t {
  kRaw,
  kJpeg,     ///< each frame is a JPEG file
  kVideo,    ///< H.264 and similar: frames depend on previous ones
  kUnknown,  ///< not supported
};
Coding coding_of(PixelCode code);

/// The format of a code whose coding is kRaw; throws std::invalid_argument for any other code.
camera_stream::PixelFormat raw_format_of(PixelCode code);

/// "YUYV, UYVY, ...": all supported codes, for messages.
std::string readable_codes();

}  // namespace panvo::v4l2_camera
