// SPDX-License-Identifier: Apache-2.0
#include "pixel_formats.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace panvo::aravis_camera {
namespace {

using camera_stream::PixelFormat;

// Formats without a name in Aravis 0.8, by their numbers in the Pixel Format Naming Convention.
constexpr ArvPixelFormat kMono10p = 0x010a0046U, kMono12p = 0x010c0047U;

constexpr std::array<std::pair<ArvPixelFormat, PixelFormat>, 17> kFormats{{
    {ARV_PIXEL_FORMAT_MONO_8, PixelFormat::kMono8},
    {ARV_PIXEL_FORMAT_MONO_10, PixelFormat::kMono10},
    {ARV_PIXEL_FORMAT_MONO_12, PixelFormat::kMono12},
    {ARV_PIXEL_FORMAT_MONO_14, PixelFormat::kMono14},
    {ARV_PIXEL_FORMAT_MONO_16, PixelFormat::kMono16},
    {kMono10p, PixelFormat::kMono10p},
    {kMono12p, PixelFormat::kMono12p},
    {ARV_PIXEL_FORMAT_MONO_10_PACKED, PixelFormat::kMono10Packed},
    {ARV_PIXEL_FORMAT_MONO_12_PACKED, PixelFormat::kMono12Packed},
    {ARV_PIXEL_FORMAT_BAYER_RG_8, PixelFormat::kBayerRG8},
    {ARV_PIXEL_FORMAT_BAYER_GR_8, PixelFormat::kBayerGR8},
    {ARV_PIXEL_FORMAT_BAYER_GB_8, PixelFormat::kBayerGB8},
    {ARV_PIXEL_FORMAT_BAYER_BG_8, PixelFormat::kBayerBG8},
    {ARV_PIXEL_FORMAT_RGB_8_PACKED, PixelFormat::kRgb8},
    {ARV_PIXEL_FORMAT_BGR_8_PACKED, PixelFormat::kBgr8},
    {ARV_PIXEL_FORMAT_YUV_422_PACKED, PixelFormat::kUyvy},
    {ARV_PIXEL_FORMAT_YUV_422_YUYV_PACKED, PixelFormat::kYuyv},
}};

}  // namespace

std::optional<PixelFormat> pixel_format_of(ArvPixelFormat format) {
  const auto found =
      std::find_if(kFormats.begin(), kFormats.end(), [&](const auto& pair) { return pair.first == format; });
  if (found == kFormats.end()) return std::nullopt;
  return found->second;
}

std::string readable_formats() {
  std::string text;
  for (const auto& [format, ours] : kFormats) text += (text.empty() ? "" : ", ") + std::string(name_of(ours));
  return text;
}

}  // namespace panvo::aravis_camera
