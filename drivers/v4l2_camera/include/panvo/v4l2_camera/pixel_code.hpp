// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "panvo/camera_stream/raw_image.hpp"

namespace panvo::v4l2_camera {

/// A pixel format as V4L2 names it: four characters, the first in the lowest byte.
using PixelCode = std::uint32_t;

constexpr PixelCode pixel_code(char a, char b, char c, char d) {
  const auto byte = [](char character) { return PixelCode{static_cast<std::uint8_t>(character)}; };
  return byte(a) | byte(b) << 8U | byte(c) << 16U | byte(d) << 24U;
}

inline constexpr PixelCode kMjpg = pixel_code('M', 'J', 'P', 'G');

/// "YUYV", "Y16"; what cannot be printed shows as a dot.
std::string to_text(PixelCode code);

/// The code of one to four characters, in whatever case, filled up with spaces: "y16". nullopt: no such code can be.
std::optional<PixelCode> parse_pixel_code(std::string_view text);

/// What the driver makes of a pixel format.
enum class Coding : std::uint8_t {
  kRaw,
  kJpeg,     ///< each frame a file of its own
  kVideo,    ///< H.264 and the like: a frame needs those before it
  kUnknown,  ///< not read here
};
Coding coding_of(PixelCode code);

/// Of a code whose coding is kRaw; throws std::invalid_argument for another.
camera_stream::PixelFormat raw_format_of(PixelCode code);

/// "YUYV, UYVY, ...": all that are read, for messages.
std::string readable_codes();

}  // namespace panvo::v4l2_camera
