// SPDX-License-Identifier: Apache-2.0
#include "panvo/v4l2_camera/image_parts.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace panvo::v4l2_camera {
namespace {

using camera_stream::PixelFormat;
using camera_stream::RawImage;
using conversions::Reason;
using conversions::Result;

/// Bytes of a pixel; 0: pixels share bytes.
std::size_t bytes_per_pixel(PixelFormat format) {
  switch (format) {
    case PixelFormat::kMono8:
    case PixelFormat::kBayerRG8:
    case PixelFormat::kBayerGR8:
    case PixelFormat::kBayerGB8:
    case PixelFormat::kBayerBG8:
      return 1;
    case PixelFormat::kMono10:
    case PixelFormat::kMono12:
    case PixelFormat::kMono14:
    case PixelFormat::kMono16:
    case PixelFormat::kYuyv:
    case PixelFormat::kUyvy:
      return 2;
    case PixelFormat::kRgb8:
    case PixelFormat::kBgr8:
      return 3;
    default:
      return 0;
  }
}

/// Whether pixels come in pairs: a half that starts within a pair would have another pattern.
bool has_pairs(PixelFormat format) {
  return format == PixelFormat::kYuyv || format == PixelFormat::kUyvy || format == PixelFormat::kBayerRG8 ||
         format == PixelFormat::kBayerGR8 || format == PixelFormat::kBayerGB8 || format == PixelFormat::kBayerBG8;
}

std::size_t step_of(const RawImage& image) {
  return image.step != 0 ? image.step : static_cast<std::size_t>(image.width) * bytes_per_pixel(image.format);
}

/// Checks format, size and number of bytes; the last row need not have its padding. Empty: valid.
std::string problem_of(const RawImage& image) {
  const std::size_t pixel = bytes_per_pixel(image.format);
  if (pixel == 0)
    return fmt::format("has the format {}, whose pixels share bytes, and cannot be split", name_of(image.format));
  if (image.width <= 0 || image.height <= 0) return fmt::format("is {} x {} px", image.width, image.height);
  const std::size_t row = static_cast<std::size_t>(image.width) * pixel;
  const std::size_t needed = step_of(image) * static_cast<std::size_t>(image.height - 1) + row;
  if (step_of(image) < row || image.bytes.size() < needed) {
    return fmt::format("holds {} bytes where {} x {} px of {} need {}", image.bytes.size(), image.width, image.height,
                       name_of(image.format), needed);
  }
  return {};
}

Reason not_divided(const RawImage& whole, const char* side, int length) {
  return Reason{
      fmt::format("is {} px {}, which {}, and cannot be split: set another size, or layout to mono", length, side,
                  length % 2 != 0 ? "is odd" : fmt::format("halves to an odd number of {}", name_of(whole.format)))};
}

}  // namespace

Result<std::vector<RawImage>> ImageSplitter::split(const RawImage& whole) {
  if (settings_.parts == ImageParts::kOne) return std::vector{whole};
  if (auto problem = problem_of(whole); !problem.empty()) return Reason{std::move(problem)};
  auto parts = settings_.parts == ImageParts::kSideBySide  ? side_by_side(whole)
               : settings_.parts == ImageParts::kTopBottom ? top_bottom(whole)
                                                           : byte_interleaved(whole);
  if (!parts || !settings_.swap) return parts;
  return std::vector{(*parts)[1], (*parts)[0]};
}

Result<std::vector<RawImage>> ImageSplitter::side_by_side(const RawImage& whole) const {
  const int unit = has_pairs(whole.format) ? 4 : 2;
  if (whole.width % unit != 0) return not_divided(whole, "wide", whole.width);
  RawImage left = whole;
  left.width = whole.width / 2;
  left.step = step_of(whole);
  RawImage right = left;
  right.bytes = whole.bytes.subspan(static_cast<std::size_t>(left.width) * bytes_per_pixel(whole.format));
  return std::vector{left, right};
}

Result<std::vector<RawImage>> ImageSplitter::top_bottom(const RawImage& whole) const {
  const bool is_pattern = has_pairs(whole.format) && bytes_per_pixel(whole.format) == 1;
  if (whole.height % (is_pattern ? 4 : 2) != 0) return not_divided(whole, "high", whole.height);
  RawImage top = whole;
  top.height = whole.height / 2;
  RawImage bottom = top;
  bottom.bytes = whole.bytes.subspan(static_cast<std::size_t>(top.height) * step_of(whole));
  return std::vector{top, bottom};
}

Result<std::vector<RawImage>> ImageSplitter::byte_interleaved(const RawImage& whole) {
  if (bytes_per_pixel(whole.format) != 2) {
    return Reason{
        fmt::format("has the format {}; interleaved eyes need pixels of two bytes: set pixel_format to Y16, "
                    "YUYV or UYVY, whichever the camera has",
                    name_of(whole.format))};
  }
  const auto width = static_cast<std::size_t>(whole.width), height = static_cast<std::size_t>(whole.height);
  first_.resize(width * height);
  second_.resize(width * height);
  for (std::size_t row = 0; row < height; ++row) {
    const std::uint8_t* source = whole.bytes.data() + row * step_of(whole);
    std::uint8_t *first = first_.data() + row * width, *second = second_.data() + row * width;
    for (std::size_t column = 0; column < width; ++column) {
      first[column] = source[2 * column];
      second[column] = source[2 * column + 1];
    }
  }
  RawImage one{settings_.interleaved, whole.width, whole.height, 0, first_}, other = one;
  other.bytes = second_;
  return std::vector{one, other};
}

}  // namespace panvo::v4l2_camera
