// SPDX-License-Identifier: Apache-2.0
#include "png.hpp"

#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <csetjmp>
#include <opencv2/imgcodecs.hpp>
#include <string>

namespace panvo::compressed_images::png {
namespace {

constexpr std::array<std::uint8_t, 8> kSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr std::array<std::uint8_t, 4> kFirstChunk{'I', 'H', 'D', 'R'};

std::uint32_t big_endian(std::span<const std::uint8_t> bytes) {
  return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 | std::uint32_t{bytes[2]} << 8 | bytes[3];
}

/// PNG reader with libpng, since OpenCV's reader prints errors on stderr. libpng leaves its functions by longjmp on
/// errors, so functions that call it must not create objects with destructors.
class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> file) : rest_(file) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, fail, ignore);
    info_ = png_ ? png_create_info_struct(png_) : nullptr;
    if (info_) png_set_read_fn(png_, this, read);
  }
  ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// Reads the header. Returns the OpenCV type of the pixels from read_pixels(); -1 on an error.
  int begin() {
    if (!info_) return -1;
    if (setjmp(png_jmpbuf(png_)) != 0) return -1;
    png_read_info(png_, info_);
    png_set_expand(png_);
    if (png_get_bit_depth(png_, info_) == 16) {
      if ((png_get_color_type(png_, info_) & PNG_COLOR_MASK_COLOR) != 0) png_set_scale_16(png_);
      if (std::endian::native == std::endian::little) png_set_swap(png_);
    }
    if ((png_get_color_type(png_, info_) & PNG_COLOR_MASK_COLOR) == 0) png_set_strip_alpha(png_);
    png_set_bgr(png_);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return CV_MAKETYPE(png_get_bit_depth(png_, info_) == 16 ? CV_16U : CV_8U, png_get_channels(png_, info_));
  }

  bool read_pixels(std::uint8_t** rows) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_image(png_, rows);
    return true;
  }

  const std::string& problem() const noexcept { return problem_; }

 private:
  [[noreturn]] static void fail(png_structp png, png_const_charp what) {
    static_cast<Reader*>(png_get_error_ptr(png))->problem_ = what;
    png_longjmp(png, 1);
  }
  static void ignore(png_structp, png_const_charp) {}
  static void read(png_structp png, png_bytep out, std::size_t size) {
    auto& rest = static_cast<Reader*>(png_get_io_ptr(png))->rest_;
    if (size > rest.size()) png_error(png, "it is cut off");
    std::copy_n(rest.begin(), size, out);
    rest = rest.subspan(size);
  }

  std::span<const std::uint8_t> rest_;
  std::string problem_ = "it has no image";
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

}  // namespace

bool is_png(std::span<const std::uint8_t> file) {
  return file.size() >= kSignature.size() && std::equal(kSignature.begin(), kSignature.end(), file.begin());
}

conversions::Result<Header> read_header(std::span<const std::uint8_t> file) {
  constexpr std::size_t kTypeAt = 12, kWidthAt = 16, kHeightAt = 20, kEnd = 24;
  if (file.size() < kEnd || !std::equal(kFirstChunk.begin(), kFirstChunk.end(), file.begin() + kTypeAt)) {
    return conversions::Reason{"is a damaged PNG file: it has no header"};
  }
  return Header{big_endian(file.subspan(kWidthAt, 4)), big_endian(file.subspan(kHeightAt, 4))};
}

conversions::Result<cv::Mat> decode(std::span<const std::uint8_t> file) {
  const auto damaged = [](const Reader& reader) {
    return conversions::Reason{"is a damaged PNG file: " + reader.problem()};
  };
  const auto header = read_header(file);
  if (!header) return conversions::Reason{header.reason()};
  Reader reader(file);
  const int type = reader.begin();
  if (type < 0) return damaged(reader);
  cv::Mat pixels(static_cast<int>(header->height), static_cast<int>(header->width), type);
  std::vector<std::uint8_t*> rows;
  for (int row = 0; row < pixels.rows; ++row) rows.push_back(pixels.ptr(row));
  if (!reader.read_pixels(rows.data())) return damaged(reader);
  return pixels;
}

std::vector<std::uint8_t> encode(const cv::Mat& pixels, int level) {
  std::vector<std::uint8_t> file;
  cv::imencode(".png", pixels, file, {cv::IMWRITE_PNG_COMPRESSION, level});
  return file;
}

}  // namespace panvo::compressed_images::png
