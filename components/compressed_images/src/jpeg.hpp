// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "panvo/conversions/result.hpp"

/// JPEG coding with libjpeg-turbo.
namespace panvo::compressed_images::jpeg {

enum class Order : std::uint8_t { kGrey, kBgr, kRgb, kBgra, kRgba };

struct Header {
  int width = 0, height = 0;
  bool is_grey = false;
};

bool is_jpeg(std::span<const std::uint8_t> file);
conversions::Result<Header> read_header(std::span<const std::uint8_t> file);

/// Fills `pixels` with `header.height` rows of `step` bytes. Returns an empty string, or the fault of the file;
/// `pixels` then holds at most a part of the image.
std::string decode(std::span<const std::uint8_t> file, const Header& header, Order order, std::size_t step,
                   std::uint8_t* pixels);

/// Throws std::runtime_error if the encoder fails, e.g. for an empty image.
std::vector<std::uint8_t> encode(const std::uint8_t* pixels, int width, int height, std::size_t step, Order order,
                                 int quality);

}  // namespace panvo::compressed_images::jpeg
