// SPDX-License-Identifier: Apache-2.0
#include "panvo/conversions/image.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string_view>

#include "panvo/conversions/time.hpp"

namespace panvo::conversions {
namespace {

constexpr int kIsGrey = -1;
constexpr double kFrom16Bit =
    255.0 / 65535.0;  // white stays white; cameras, decoders and all panorama subscribers use this scale

struct Encoding {
  std::string_view name;
  int type;     ///< OpenCV type
  int to_grey;  ///< OpenCV conversion code
};

constexpr std::array kEncodings{Encoding{"mono8", CV_8UC1, kIsGrey},
                                Encoding{"mono16", CV_16UC1, kIsGrey},
                                Encoding{"bgr8", CV_8UC3, cv::COLOR_BGR2GRAY},
                                Encoding{"rgb8", CV_8UC3, cv::COLOR_RGB2GRAY},
                                Encoding{"bgra8", CV_8UC4, cv::COLOR_BGRA2GRAY},
                                Encoding{"rgba8", CV_8UC4, cv::COLOR_RGBA2GRAY},
                                Encoding{"8UC1", CV_8UC1, kIsGrey},
                                Encoding{"8UC3", CV_8UC3, cv::COLOR_BGR2GRAY},
                                Encoding{"16UC1", CV_16UC1, kIsGrey}};

const Encoding* find(std::string_view name) {
  for (const auto& encoding : kEncodings) {
    if (encoding.name == name) return &encoding;
  }
  return nullptr;
}

}  // namespace

Result<cv::Mat> view(const sensor_msgs::msg::Image& image) {
  const auto* encoding = find(image.encoding());
  if (encoding == nullptr) {
    return Reason{fmt::format(
        "has encoding '{}'; supported are mono8, mono16, rgb8, bgr8, rgba8 and bgra8: set the camera driver "
        "to one of them",
        image.encoding())};
  }
  constexpr std::uint32_t kMaxSide_px = 1U << 16;
  if (image.width() == 0 || image.height() == 0 || image.width() > kMaxSide_px || image.height() > kMaxSide_px) {
    return Reason{fmt::format("has an invalid size of {} x {} px", image.width(), image.height())};
  }
  const auto pixel_bytes = static_cast<std::size_t>(CV_ELEM_SIZE(encoding->type));
  const std::size_t row_bytes = image.width() * pixel_bytes;
  const std::size_t step = image.step();
  if (step < row_bytes || step % static_cast<std::size_t>(CV_ELEM_SIZE1(encoding->type)) != 0) {
    return Reason{fmt::format("has a step of {} bytes, but {} px of {} need {}", step, image.width(), image.encoding(),
                              row_bytes)};
  }
  const std::size_t needed = step * (image.height() - 1) + row_bytes;  // the last row may lack its padding
  if (image.data().size() < needed) {
    return Reason{fmt::format("holds {} bytes where {} x {} px of {} need {}", image.data().size(), image.width(),
                              image.height(), image.encoding(), needed)};
  }
  if (pixel_bytes == 2 && (image.is_bigendian() != 0) != (std::endian::native == std::endian::big)) {
    return Reason{"has 16-bit pixels in the byte order of another machine; send mono8 instead"};
  }
  // cv::Mat has no constant pixels; callers must not write, see view().
  auto* data = const_cast<std::uint8_t*>(image.data().data());
  return cv::Mat(static_cast<int>(image.height()), static_cast<int>(image.width()), encoding->type, data, step);
}

Result<cv::Mat> grey(const sensor_msgs::msg::Image& image) {
  auto pixels = view(image);
  if (!pixels || pixels->type() == CV_8UC1) return pixels;
  cv::Mat grey;
  const int to_grey = find(image.encoding())->to_grey;
  if (to_grey == kIsGrey) {
    pixels->convertTo(grey, CV_8U, kFrom16Bit);
  } else {
    cv::cvtColor(*pixels, grey, to_grey);
  }
  return grey;
}

Result<cv::Mat> grey_or_bgr(const sensor_msgs::msg::Image& image) {
  auto pixels = view(image);
  if (!pixels) return pixels;
  if (pixels->channels() == 1) return grey(image);
  const bool is_rgb = image.encoding().starts_with("rgb");
  if (!is_rgb && pixels->channels() == 3) return pixels;
  cv::Mat bgr;
  const int to_bgr = pixels->channels() == 3 ? cv::COLOR_RGB2BGR : is_rgb ? cv::COLOR_RGBA2BGR : cv::COLOR_BGRA2BGR;
  cv::cvtColor(*pixels, bgr, to_bgr);
  return bgr;
}

std::shared_ptr<sensor_msgs::msg::Image> make_image(std::int64_t stamp_ns, const std::string& frame_id,
                                                    const std::string& encoding_name, int width, int height) {
  const auto* encoding = find(encoding_name);
  if (encoding == nullptr) throw std::invalid_argument("unsupported image encoding '" + encoding_name + "'");
  if (width <= 0 || height <= 0)
    throw std::invalid_argument(fmt::format("invalid image size: {} x {} px", width, height));
  auto image = std::make_shared<sensor_msgs::msg::Image>();
  image->header().stamp(to_stamp(stamp_ns));
  image->header().frame_id(frame_id);
  image->encoding(encoding_name);
  image->width(static_cast<std::uint32_t>(width));
  image->height(static_cast<std::uint32_t>(height));
  image->is_bigendian(std::endian::native == std::endian::big ? 1 : 0);
  image->step(static_cast<std::uint32_t>(width * CV_ELEM_SIZE(encoding->type)));
  image->data().resize(std::size_t{image->step()} * image->height());
  return image;
}

cv::Mat pixels(sensor_msgs::msg::Image& image) {
  const auto pixels = view(image);
  if (!pixels) throw std::invalid_argument("image " + pixels.reason());
  return *pixels;
}

std::string encoding_of(int opencv_type) {
  for (const auto& encoding : kEncodings) {
    if (encoding.type == opencv_type) return std::string(encoding.name);
  }
  throw std::invalid_argument("no encoding for OpenCV's type " + cv::typeToString(opencv_type));
}

}  // namespace panvo::conversions
