// SPDX-License-Identifier: Apache-2.0
#include "panvo/v4l2_camera/jpeg.hpp"

#include <fmt/format.h>
#include <turbojpeg.h>

#include <memory>
#include <stdexcept>
#include <string>

namespace panvo::v4l2_camera {
namespace {

using camera_stream::PixelFormat;
using conversions::Reason;

struct Destroy {
  void operator()(void* handle) const { tjDestroy(handle); }
};

bool is_padding(const std::string& warning) { return warning.find("before marker 0xd9") != std::string::npos; }

}  // namespace

conversions::Result<camera_stream::RawImage> JpegDecoder::decode(std::span<const std::uint8_t> file, int width,
                                                                 int height, bool as_grey) {
  // A new decompressor for each file: state left by a damaged header would corrupt the following files.
  const std::unique_ptr<void, Destroy> handle(tjInitDecompress());
  if (!handle) throw std::runtime_error("libjpeg-turbo cannot be initialised: out of memory?");
  int file_width = 0, file_height = 0, subsampling = 0, colours = 0;
  if (file.size() < 2 || file[0] != 0xff || file[1] != 0xd8) return Reason{"is not a JPEG file"};
  if (tjDecompressHeader3(handle.get(), file.data(), file.size(), &file_width, &file_height, &subsampling, &colours) !=
      0)
    return Reason{fmt::format("is a damaged JPEG file: {}", tjGetErrorStr2(handle.get()))};
  // libjpeg-turbo accepts a file that ends before its image data as a tables-only file.
  if (file_width == 0 || file_height == 0) return Reason{"is a damaged JPEG file: it ends before the image data"};
  if (file_width != width || file_height != height) {
    return Reason{
        fmt::format("is a JPEG file of {} x {} px in a stream of {} x {} px", file_width, file_height, width, height)};
  }
  const bool is_grey = as_grey || colours == TJCS_GRAY;
  const std::size_t step = static_cast<std::size_t>(width) * (is_grey ? 1U : 3U);
  pixels_.resize(step * static_cast<std::size_t>(height));
  if (tjDecompress2(handle.get(), file.data(), file.size(), pixels_.data(), width, static_cast<int>(step), height,
                    is_grey ? TJPF_GRAY : TJPF_BGR, TJFLAG_LIMITSCANS) != 0) {
    const std::string problem = tjGetErrorStr2(handle.get());
    if (tjGetErrorCode(handle.get()) != TJERR_WARNING || !is_padding(problem))
      return Reason{"is a damaged JPEG file: " + problem};
  }
  return camera_stream::RawImage{is_grey ? PixelFormat::kMono8 : PixelFormat::kBgr8, width, height, step, pixels_};
}

}  // namespace panvo::v4l2_camera
