// SPDX-License-Identifier: Apache-2.0
#include "panvo/v4l2_camera/frame_reader.hpp"

#include <fmt/format.h>

namespace panvo::v4l2_camera {
namespace {

using camera_stream::RawImage;
using Outcome = ReadFrame::Outcome;

/// Number of bytes of the image, with the gaps between rows.
std::size_t needed_bytes(const ImageFormat& format) { return format.step * static_cast<std::size_t>(format.height); }

}  // namespace

FrameReader::FrameReader(const CameraSettings& settings, const ImageFormat& format)
    : frame_ids_(settings.frame_ids), output_(settings.output), format_(format), splitter_(settings.parts) {}

ReadFrame FrameReader::read(const BufferedFrame& frame) {
  if (frame.is_damaged) return {Outcome::kDamaged, "is marked as damaged by its driver", {}};
  RawImage whole;
  if (coding_of(format_.pixels) == Coding::kJpeg) {
    const auto decoded =
        jpeg_.decode(frame.bytes, format_.width, format_.height, output_ == camera_stream::ImageOutput::kGrey);
    if (!decoded) return {frame.bytes.empty() ? Outcome::kIncomplete : Outcome::kDamaged, decoded.reason(), {}};
    whole = *decoded;
  } else {
    if (frame.bytes.size() < needed_bytes(format_)) {
      return {
          Outcome::kIncomplete,
          fmt::format("holds {} bytes where {} need {}", frame.bytes.size(), to_text(format_), needed_bytes(format_)),
          {}};
    }
    whole = {raw_format_of(format_.pixels), format_.width, format_.height, format_.step, frame.bytes};
  }
  const auto parts = splitter_.split(whole);
  if (!parts) return {Outcome::kDamaged, parts.reason(), {}};
  ReadFrame result;
  for (std::size_t i = 0; i < parts->size(); ++i) {
    const auto image = camera_stream::to_image((*parts)[i], output_, frame_ids_.at(i));
    if (!image) return {Outcome::kDamaged, image.reason(), {}};
    result.images.push_back(*image);
  }
  return result;
}

}  // namespace panvo::v4l2_camera
