// SPDX-License-Identifier: Apache-2.0
#include <linux/videodev2.h>

#include <algorithm>
#include <functional>

#include "kernel/device_file.hpp"

namespace panvo::v4l2_camera::kernel {
namespace {

std::vector<double> frame_rates(const DeviceFile& file, PixelCode pixels, int width, int height) {
  std::vector<double> rates_hz;
  v4l2_frmivalenum interval{};
  interval.pixel_format = pixels;
  interval.width = static_cast<std::uint32_t>(width);
  interval.height = static_cast<std::uint32_t>(height);
  for (; file.try_request(VIDIOC_ENUM_FRAMEINTERVALS, &interval); ++interval.index) {
    if (interval.type != V4L2_FRMIVAL_TYPE_DISCRETE) {
      rates_hz = {rate_of(interval.stepwise.min), rate_of(interval.stepwise.max)};
      break;
    }
    rates_hz.push_back(rate_of(interval.discrete));
  }
  std::sort(rates_hz.begin(), rates_hz.end(), std::greater<>());
  return rates_hz;
}

std::vector<OfferedSize> frame_sizes(const DeviceFile& file, PixelCode pixels) {
  std::vector<OfferedSize> sizes;
  v4l2_frmsizeenum size{};
  size.pixel_format = pixels;
  for (; file.try_request(VIDIOC_ENUM_FRAMESIZES, &size); ++size.index) {
    OfferedSize offered;
    if (size.type == V4L2_FRMSIZE_TYPE_DISCRETE) {
      offered.width = static_cast<int>(size.discrete.width);
      offered.height = static_cast<int>(size.discrete.height);
    } else {
      const auto& range = size.stepwise;
      offered = {static_cast<int>(range.max_width),
                 static_cast<int>(range.max_height),
                 static_cast<int>(range.min_width),
                 static_cast<int>(range.min_height),
                 std::max(1, static_cast<int>(range.step_width)),
                 std::max(1, static_cast<int>(range.step_height)),
                 {}};
    }
    offered.rates_hz = frame_rates(file, pixels, offered.width, offered.height);
    sizes.push_back(std::move(offered));
    if (size.type != V4L2_FRMSIZE_TYPE_DISCRETE) break;  // a single range describes all sizes
  }
  return sizes;
}

}  // namespace

double rate_of(const v4l2_fract& interval) {
  return interval.numerator > 0 ? static_cast<double>(interval.denominator) / interval.numerator : 0.0;
}

std::vector<OfferedFormat> offered_formats(const DeviceFile& file) {
  std::vector<OfferedFormat> formats;
  v4l2_fmtdesc description{};
  description.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  for (; file.try_request(VIDIOC_ENUM_FMT, &description); ++description.index) {
    formats.push_back({description.pixelformat, text_of(description.description, sizeof description.description),
                       frame_sizes(file, description.pixelformat)});
  }
  return formats;
}

}  // namespace panvo::v4l2_camera::kernel
