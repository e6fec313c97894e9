// SPDX-License-Identifier: Apache-2.0
#include "jpeg.hpp"

#include <turbojpeg.h>

#include <array>
#include <memory>
#include <stdexcept>
#include <string>

namespace panvo::compressed_images::jpeg {
namespace {

struct Destroy {
  void operator()(void* handle) const { tjDestroy(handle); }
};
using Handle = std::unique_ptr<void, Destroy>;

constexpr std::array kPixelFormats{TJPF_GRAY, TJPF_BGR, TJPF_RGB, TJPF_BGRA, TJPF_RGBA};  // by Order

int pixel_format(Order order) { return kPixelFormats.at(static_cast<std::size_t>(order)); }

/// Many USB cameras insert padding before the end marker, which does not affect the image. libjpeg-turbo reports only
/// the first warning of a file, so this one hides no other fault.
bool is_only_padding(const std::string& warning) {
  return warning.find("extraneous bytes before marker 0xd9") != std::string::npos;
}

}  // namespace

bool is_jpeg(std::span<const std::uint8_t> file) {
  return file.size() >= 3 && file[0] == 0xff && file[1] == 0xd8 && file[2] == 0xff;
}

conversions::Result<Header> read_header(std::span<const std::uint8_t> file) {
  const Handle handle(tjInitDecompress());
  Header header;
  int subsampling = 0, colours = 0;
  if (tjDecompressHeader3(handle.get(), file.data(), file.size(), &header.width, &header.height, &subsampling,
                          &colours) != 0) {
    return conversions::Reason{"is a damaged JPEG file: " + std::string(tjGetErrorStr2(handle.get()))};
  }
  header.is_grey = colours == TJCS_GRAY;
  return header;
}

std::string decode(std::span<const std::uint8_t> file, const Header& header, Order order, std::size_t step,
                   std::uint8_t* pixels) {
  const Handle handle(tjInitDecompress());
  // With the accurate DCT, decoders differ by at most one grey level.
  constexpr int kFlags = TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS;
  if (tjDecompress2(handle.get(), file.data(), file.size(), pixels, header.width, static_cast<int>(step), header.height,
                    pixel_format(order), kFlags) == 0) {
    return "";
  }
  const std::string problem = tjGetErrorStr2(handle.get());
  return tjGetErrorCode(handle.get()) == TJERR_WARNING && is_only_padding(problem) ? "" : problem;
}

std::vector<std::uint8_t> encode(const std::uint8_t* pixels, int width, int height, std::size_t step, Order order,
                                 int quality) {
  constexpr int kFullColourFrom = 90;
  const int subsampling = order == Order::kGrey ? TJSAMP_GRAY : quality >= kFullColourFrom ? TJSAMP_444 : TJSAMP_420;
  const Handle handle(tjInitCompress());
  std::vector<std::uint8_t> file(tjBufSize(width, height, subsampling));
  std::uint8_t* data = file.data();
  unsigned long size = file.size();
  if (tjCompress2(handle.get(), pixels, width, static_cast<int>(step), height, pixel_format(order), &data, &size,
                  subsampling, quality, TJFLAG_ACCURATEDCT | TJFLAG_NOREALLOC) != 0) {
    throw std::runtime_error("JPEG encoding failed: " + std::string(tjGetErrorStr2(handle.get())));
  }
  file.resize(size);
  return file;
}

}  // namespace panvo::compressed_images::jpeg
