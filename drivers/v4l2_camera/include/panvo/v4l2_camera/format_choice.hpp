// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "panvo/conversions/result.hpp"
#include "panvo/v4l2_camera/pixel_code.hpp"

namespace panvo::v4l2_camera {

/// An image size of a camera or, if `step_x` or `step_y` is not 0, the largest size of a range.
struct OfferedSize {
  int width = 0, height = 0;                                  ///< px
  int min_width = 0, min_height = 0, step_x = 0, step_y = 0;  ///< of a range, px
  std::vector<double> rates_hz{};                             ///< descending; empty: not known

  bool includes(int wanted_width, int wanted_height) const;
};

struct OfferedFormat {
  PixelCode pixels = 0;
  std::string description{};  ///< given by the camera: "Motion-JPEG"
  std::vector<OfferedSize> sizes{};
};

/// Pixel format and memory layout of the images sent.
struct ImageFormat {
  PixelCode pixels = 0;
  int width = 0, height = 0;  ///< px
  std::size_t step = 0;       ///< bytes from one row to the next; 0: rows without gaps, or no rows (JPEG)
};

/// The format requested by the user; empty or 0: not specified.
struct FormatWish {
  std::string pixel_format{};  ///< four characters
  int width = 0, height = 0;   ///< px
  double rate_hz = 0.0;
  bool prefers_grey = false;  ///< only grey is needed: prefer a grey format, which has less data
};

/// Chooses the format to request from the camera. Without a requested pixel format: the current one if it supports the
/// size and rate; otherwise the format closest to the rate (without a rate: the fastest), raw before JPEG. Fails with
/// cause and remedy if no format is readable.
conversions::Result<ImageFormat> choose_format(const std::vector<OfferedFormat>& offered, const ImageFormat& current,
                                               const FormatWish& wish);

/// "MJPG 1280 x 480 px"
std::string to_text(const ImageFormat& format);

/// Why images in the actual format cannot be read, with a remedy; empty if they can.
std::string format_problem(const ImageFormat& given, const std::vector<OfferedFormat>& offered);

/// One message for each request that the camera did not fulfil: "format MJPG 1000 x 481 px: the camera gives YUYV 640 x
/// 480 px". `given_rate_hz` 0: the rate cannot be set.
std::vector<std::string> not_given(const FormatWish& wish, const ImageFormat& asked, const ImageFormat& given,
                                   double given_rate_hz);

}  // namespace panvo::v4l2_camera
