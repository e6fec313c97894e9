// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_stream/raw_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "panvo/conversions/image.hpp"
#include "unpack.hpp"

namespace panvo::camera_stream {
namespace {

constexpr int kNone = -1;

struct Format {
  PixelFormat format;
  std::string_view name;
  int type;                  ///< OpenCV type of the unpacked pixels
  std::string_view as_sent;  ///< ROS encoding
  std::string_view readable;
  int to_readable, to_grey;  ///< OpenCV conversions
};

// The names with four letters (COLOR_BayerRGGB2BGR) give the first two rows, as ROS and GenICam do; OpenCV's older
// two-letter names give the second and third pixel of the second row.
constexpr std::array kFormats{
    Format{PixelFormat::kMono8, "Mono8", CV_8UC1, "mono8", "mono8", kNone, kNone},
    Format{PixelFormat::kMono10, "Mono10", CV_16UC1, "mono16", "mono16", kNone, kNone},
    Format{PixelFormat::kMono12, "Mono12", CV_16UC1, "mono16", "mono16", kNone, kNone},
    Format{PixelFormat::kMono14, "Mono14", CV_16UC1, "mono16", "mono16", kNone, kNone},
    Format{PixelFormat::kMono16, "Mono16", CV_16UC1, "mono16", "mono16", kNone, kNone},
    Format{PixelFormat::kMono10p, "Mono10p", CV_16UC1, "mono16", "mono16", kNone, kNone},
    Format{PixelFormat::kMono12p, "Mono12p", CV_16UC1, "mono16", "mono16", kNone, kNone},
    Format{PixelFormat::kMono10Packed, "Mono10Packed", CV_16UC1, "mono16", "mono16", kNone, kNone},
    Format{PixelFormat::kMono12Packed, "Mono12Packed", CV_16UC1, "mono16", "mono16", kNone, kNone},
    Format{PixelFormat::kBayerRG8, "BayerRG8", CV_8UC1, "bayer_rggb8", "bgr8", cv::COLOR_BayerRGGB2BGR,
           cv::COLOR_BayerRGGB2GRAY},
    Format{PixelFormat::kBayerGR8, "BayerGR8", CV_8UC1, "bayer_grbg8", "bgr8", cv::COLOR_BayerGRBG2BGR,
           cv::COLOR_BayerGRBG2GRAY},
    Format{PixelFormat::kBayerGB8, "BayerGB8", CV_8UC1, "bayer_gbrg8", "bgr8", cv::COLOR_BayerGBRG2BGR,
           cv::COLOR_BayerGBRG2GRAY},
    Format{PixelFormat::kBayerBG8, "BayerBG8", CV_8UC1, "bayer_bggr8", "bgr8", cv::COLOR_BayerBGGR2BGR,
           cv::COLOR_BayerBGGR2GRAY},
    Format{PixelFormat::kRgb8, "RGB8", CV_8UC3, "rgb8", "rgb8", kNone, cv::COLOR_RGB2GRAY},
    Format{PixelFormat::kBgr8, "BGR8", CV_8UC3, "bgr8", "bgr8", kNone, cv::COLOR_BGR2GRAY},
    Format{PixelFormat::kYuyv, "YUV422_8", CV_8UC2, "yuv422_yuy2", "bgr8", cv::COLOR_YUV2BGR_YUYV,
           cv::COLOR_YUV2GRAY_YUY2},
    Format{PixelFormat::kUyvy, "YUV422_8_UYVY", CV_8UC2, "yuv422", "bgr8", cv::COLOR_YUV2BGR_UYVY,
           cv::COLOR_YUV2GRAY_UYVY}};

const Format& format_of(PixelFormat format) {
  const auto* found =
      std::find_if(kFormats.begin(), kFormats.end(), [&](const Format& f) { return f.format == format; });
  if (found == kFormats.end()) throw std::invalid_argument("no such pixel format");
  return *found;
}

/// A message in an encoding that panvo_conversions does not support.
std::shared_ptr<sensor_msgs::msg::Image> make_image(const Format& format, std::string_view encoding, int width,
                                                    int height, const std::string& frame_id) {
  auto image = std::make_shared<sensor_msgs::msg::Image>();
  image->header().frame_id(frame_id);
  image->encoding(std::string(encoding));
  image->width(static_cast<std::uint32_t>(width));
  image->height(static_cast<std::uint32_t>(height));
  image->is_bigendian(std::endian::native == std::endian::big ? 1 : 0);
  image->step(static_cast<std::uint32_t>(static_cast<std::size_t>(width) * CV_ELEM_SIZE(format.type)));
  image->data().resize(std::size_t{image->step()} * image->height());
  return image;
}

std::string problem_of(const RawImage& raw, const Format& format) {
  constexpr int kMaxSide_px = 1 << 16;
  if (raw.width <= 0 || raw.height <= 0 || raw.width > kMaxSide_px || raw.height > kMaxSide_px)
    return fmt::format("is {} x {} px, which is not an image size", raw.width, raw.height);
  if (format.type == CV_8UC2 && raw.width % 2 != 0)
    return fmt::format("is {} px wide, but {} stores pixels in pairs: set an even width", raw.width, format.name);
  std::size_t needed = packed_bytes(raw.format, raw.width, raw.height);
  if (raw.step != 0) {
    const std::size_t row_bytes = needed / static_cast<std::size_t>(raw.height);
    if (is_packed(raw.format)) return fmt::format("has gaps between rows, which is not supported for {}", format.name);
    if (raw.step < row_bytes)
      return fmt::format("has rows of {} bytes where {} px of {} need {}", raw.step, raw.width, format.name, row_bytes);
    needed = raw.step * static_cast<std::size_t>(raw.height - 1) + row_bytes;
  }
  if (raw.bytes.size() >= needed) return {};
  return fmt::format("holds {} bytes where {} x {} px of {} need {}", raw.bytes.size(), raw.width, raw.height,
                     format.name, needed);
}

}  // namespace

std::string_view name_of(PixelFormat format) { return format_of(format).name; }

conversions::Result<std::shared_ptr<sensor_msgs::msg::Image>> to_image(const RawImage& raw, ImageOutput output,
                                                                       const std::string& frame_id) {
  const Format& format = format_of(raw.format);
  if (auto problem = problem_of(raw, format); !problem.empty()) return conversions::Reason{std::move(problem)};
  const bool is_grey = output == ImageOutput::kGrey;
  const int conversion = output == ImageOutput::kAsSent ? kNone : is_grey ? format.to_grey : format.to_readable;

  // The cv::Mat below is only read.
  auto* bytes = const_cast<std::uint8_t*>(raw.bytes.data());
  cv::Mat sent;
  if (is_packed(raw.format)) {
    sent.create(raw.height, raw.width, CV_16UC1);
    unpack(raw, sent);
  } else {
    sent =
        cv::Mat(raw.height, raw.width, format.type, bytes, raw.step == 0 ? std::size_t{cv::Mat::AUTO_STEP} : raw.step);
  }

  const bool is_deep_grey = is_grey && format.type == CV_16UC1;
  const auto encoding = is_grey ? "mono8" : output == ImageOutput::kAsSent ? format.as_sent : format.readable;
  if (output == ImageOutput::kAsSent) {
    auto image = make_image(format, encoding, raw.width, raw.height, frame_id);
    cv::Mat pixels(raw.height, raw.width, format.type, image->data().data(), image->step());
    if (shift_of(raw.format) > 0) {
      sent.convertTo(pixels, CV_16U, 1 << shift_of(raw.format));
    } else {
      sent.copyTo(pixels);
    }
    return image;
  }
  auto image = conversions::make_image(0, frame_id, std::string(encoding), raw.width, raw.height);
  cv::Mat pixels = conversions::pixels(*image);
  if (conversion != kNone) {
    cv::cvtColor(sent, pixels, conversion);
  } else if (is_deep_grey) {
    sent.convertTo(pixels, CV_8U, (1 << shift_of(raw.format)) / 257.0);
  } else if (shift_of(raw.format) > 0) {
    sent.convertTo(pixels, CV_16U, 1 << shift_of(raw.format));
  } else {
    sent.copyTo(pixels);
  }
  return image;
}

}  // namespace panvo::camera_stream
