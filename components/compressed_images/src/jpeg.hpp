// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "panvo/conversions/result.hpp"

/// JPEG files by libjpeg-turbo.
namespace panvo::compressed_images::jpeg {

enum class Order : std::uint8_t { kGrey, kBgr, kRgb, kBgra, kRgba };

struct Header {
  int width = 0, height = 0;
  bool is_grey = false;
};

bool is_jpeg(std::span<const std::uint8_t> file);
conversions::Result<Header> read_header(std::span<const std::uint8_t> file);

/// Fills `pixels` with `header.height` rows of `step` bytes. Empty, or what is wrong with the file: it then holds part of
/// a picture at best.
std::string decode(std::span<const std::uint8_t> file, const Header& header, Order order, std::size_t step,
                   std::uint8_t* pixels);

/// Throws std::runtime_error for what is no picture.
std::vector<std::uint8_t> encode(const std::uint8_t* pixels, int width, int height, std::size_t step, Order order,
                                 int quality);

}  // namespace panvo::compressed_images::jpeg
