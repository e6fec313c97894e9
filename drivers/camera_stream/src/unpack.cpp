// SPDX-License-Identifier: Apache-2.0
#include "unpack.hpp"

namespace panvo::camera_stream {
namespace {

int bits_of(PixelFormat format) {
  switch (format) {
    case PixelFormat::kMono10p:
      return 10;
    case PixelFormat::kMono12p:
    case PixelFormat::kMono10Packed:
    case PixelFormat::kMono12Packed:
      return 12;
    case PixelFormat::kMono10:
    case PixelFormat::kMono12:
    case PixelFormat::kMono14:
    case PixelFormat::kMono16:
    case PixelFormat::kYuyv:
    case PixelFormat::kUyvy:
      return 16;
    case PixelFormat::kRgb8:
    case PixelFormat::kBgr8:
      return 24;
    default:
      return 8;
  }
}

/// Unpacks consecutive pixels of `bits` bits, lowest bit first.
void unpack_stream(const std::uint8_t* bytes, std::size_t count, int bits, std::uint16_t* pixels) {
  std::uint32_t waiting = 0;
  int waiting_bits = 0;
  const std::uint32_t mask = (1U << bits) - 1U;
  for (std::size_t i = 0; i < count; ++i) {
    while (waiting_bits < bits) {
      waiting |= std::uint32_t{*bytes++} << waiting_bits;
      waiting_bits += 8;
    }
    pixels[i] = static_cast<std::uint16_t>((waiting & mask) << (16 - bits));
    waiting >>= bits;
    waiting_bits -= bits;
  }
}

/// Unpacks pairs of pixels from three bytes: the outer bytes have the upper 8 bits of each pixel, the lower and upper
/// half of the middle byte the `low_bits` of the first and second pixel.
void unpack_pairs(const std::uint8_t* bytes, std::size_t count, int low_bits, std::uint16_t* pixels) {
  const unsigned mask = (1U << low_bits) - 1U;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* triple = bytes + i / 2 * 3;
    const unsigned high = i % 2 == 0 ? triple[0] : triple[2];
    const unsigned low = (i % 2 == 0 ? unsigned{triple[1]} : unsigned{triple[1]} >> 4) & mask;
    pixels[i] = static_cast<std::uint16_t>((high << 8) | (low << (8 - low_bits)));
  }
}

}  // namespace

std::size_t packed_bytes(PixelFormat format, int width, int height) {
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  return (count * static_cast<std::size_t>(bits_of(format)) + 7) / 8;
}

int shift_of(PixelFormat format) {
  switch (format) {
    case PixelFormat::kMono10:
      return 6;
    case PixelFormat::kMono12:
      return 4;
    case PixelFormat::kMono14:
      return 2;
    default:
      return 0;
  }
}

bool is_packed(PixelFormat format) {
  return format == PixelFormat::kMono10p || format == PixelFormat::kMono12p || format == PixelFormat::kMono10Packed ||
         format == PixelFormat::kMono12Packed;
}

void unpack(const RawImage& raw, cv::Mat& pixels) {
  const auto count = static_cast<std::size_t>(raw.width) * static_cast<std::size_t>(raw.height);
  auto* out = pixels.ptr<std::uint16_t>();
  switch (raw.format) {
    case PixelFormat::kMono10p:
      return unpack_stream(raw.bytes.data(), count, 10, out);
    case PixelFormat::kMono12p:
      return unpack_stream(raw.bytes.data(), count, 12, out);
    case PixelFormat::kMono10Packed:
      return unpack_pairs(raw.bytes.data(), count, 2, out);
    default:
      return unpack_pairs(raw.bytes.data(), count, 4, out);
  }
}

}  // namespace panvo::camera_stream
