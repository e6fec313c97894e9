// SPDX-License-Identifier: Apache-2.0
#include "panvo/v4l2_camera/pixel_code.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>
#include <utility>

namespace panvo::v4l2_camera {
namespace {

using camera_stream::PixelFormat;

// Grey of 10 to 16 bits has two bytes per pixel, low byte first.
constexpr std::array kRaw{std::pair{pixel_code('G', 'R', 'E', 'Y'), PixelFormat::kMono8},
                          std::pair{pixel_code('Y', '1', '0', ' '), PixelFormat::kMono10},
                          std::pair{pixel_code('Y', '1', '2', ' '), PixelFormat::kMono12},
                          std::pair{pixel_code('Y', '1', '4', ' '), PixelFormat::kMono14},
                          std::pair{pixel_code('Y', '1', '6', ' '), PixelFormat::kMono16},
                          std::pair{pixel_code('Y', 'U', 'Y', 'V'), PixelFormat::kYuyv},
                          std::pair{pixel_code('U', 'Y', 'V', 'Y'), PixelFormat::kUyvy},
                          std::pair{pixel_code('R', 'G', 'B', '3'), PixelFormat::kRgb8},
                          std::pair{pixel_code('B', 'G', 'R', '3'), PixelFormat::kBgr8},
                          std::pair{pixel_code('R', 'G', 'G', 'B'), PixelFormat::kBayerRG8},
                          std::pair{pixel_code('G', 'R', 'B', 'G'), PixelFormat::kBayerGR8},
                          std::pair{pixel_code('G', 'B', 'R', 'G'), PixelFormat::kBayerGB8},
                          std::pair{pixel_code('B', 'A', '8', '1'), PixelFormat::kBayerBG8}};
constexpr std::array kJpeg{kMjpg, pixel_code('J', 'P', 'E', 'G')};
constexpr std::array kVideo{pixel_code('H', '2', '6', '4'), pixel_code('A', 'V', 'C', '1'),
                            pixel_code('M', '2', '6', '4'), pixel_code('H', 'E', 'V', 'C'),
                            pixel_code('V', 'P', '8', '0'), pixel_code('V', 'P', '9', '0'),
                            pixel_code('M', 'P', 'G', '1'), pixel_code('M', 'P', 'G', '2'),
                            pixel_code('M', 'P', 'G', '4'), pixel_code('X', 'V', 'I', 'D')};

const std::pair<PixelCode, PixelFormat>* find_raw(PixelCode code) {
  const auto* found = std::find_if(kRaw.begin(), kRaw.end(), [&](const auto& entry) { return entry.first == code; });
  return found == kRaw.end() ? nullptr : found;
}

}  // namespace

std::string to_text(PixelCode code) {
  std::string text;
  for (unsigned shift = 0; shift < 32; shift += 8) {
    const auto character = static_cast<unsigned char>((code >> shift) & 0xffU);
    text += std::isprint(character) != 0 ? static_cast<char>(character) : '.';
  }
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

std::optional<PixelCode> parse_pixel_code(std::string_view text) {
  if (text.empty() || text.size() > 4) return std::nullopt;
  std::array<char, 4> characters{' ', ' ', ' ', ' '};
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto character = static_cast<unsigned char>(text[i]);
    if (std::isprint(character) == 0) return std::nullopt;
    characters[i] = static_cast<char>(std::toupper(character));
  }
  return pixel_code(characters[0], characters[1], characters[2], characters[3]);
}

Coding coding_of(PixelCode code) {
  if (find_raw(code) != nullptr) return Coding::kRaw;
  if (std::find(kJpeg.begin(), kJpeg.end(), code) != kJpeg.end()) return Coding::kJpeg;
  if (std::find(kVideo.begin(), kVideo.end(), code) != kVideo.end()) return Coding::kVideo;
  return Coding::kUnknown;
}

PixelFormat raw_format_of(PixelCode code) {
  const auto* found = find_raw(code);
  if (found == nullptr) throw std::invalid_argument(to_text(code) + " is not a raw pixel format");
  return found->second;
}

std::string readable_codes() {
  std::string text;
  for (const auto& [code, format] : kRaw) text += to_text(code) + ", ";
  return text + to_text(kMjpg);
}

}  // namespace panvo::v4l2_camera
