// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "panvo/conversions/result.hpp"
#include "panvo/v4l2_camera/pixel_code.hpp"

namespace panvo::v4l2_camera {

/// A size in which a camera sends images, or, where `step_x` or `step_y` is not 0, the largest of a range of sizes.
struct OfferedSize {
  int width = 0, height = 0;                                      ///< px
  int least_width = 0, least_height = 0, step_x = 0, step_y = 0;  ///< of a range, px
  std::vector<double> rates_hz{};                                 ///< the highest first; empty: not known

  bool includes(int wanted_width, int wanted_height) const;
};

struct OfferedFormat {
  PixelCode pixels = 0;
  std::string description{};  ///< the camera's own words: "Motion-JPEG"
  std::vector<OfferedSize> sizes{};
};

/// How images are sent.
struct ImageFormat {
  PixelCode pixels = 0;
  int width = 0, height = 0;  ///< px
  std::size_t step = 0;       ///< bytes from one row to the next; 0: rows without gaps, or no rows (JPEG)
};

/// What the user asks for; what is empty or 0 is left to the camera.
struct FormatWish {
  std::string pixel_format{};  ///< four characters
  int width = 0, height = 0;   ///< px
  double rate_hz = 0.0;
  bool prefers_grey = false;  ///< only grey is needed: less to carry where the camera sends it
};

/// What to ask the camera for. Where no pixel format is wished: what the camera is set to, if it comes in the size and at the rate; otherwise the format
/// that comes nearest to the rate (none wished: the fastest), raw before JPEG. The reason says why no image can be read, and what to do.
conversions::Result<ImageFormat> choose_format(const std::vector<OfferedFormat>& offered, const ImageFormat& current,
                                               const FormatWish& wish);

/// "MJPG 1280 x 480 px"
std::string to_text(const ImageFormat& format);

/// Why images as the camera gives them cannot be read, and what to do; empty: they can.
std::string format_problem(const ImageFormat& given, const std::vector<OfferedFormat>& offered);

/// What the camera did not give, a sentence each: "format MJPG 1000 x 481 px: the camera gives YUYV 640 x 480 px". `given_rate_hz` 0: not known.
std::vector<std::string> not_given(const FormatWish& wish, const ImageFormat& asked, const ImageFormat& given,
                                   double given_rate_hz);

}  // namespace panvo::v4l2_camera
