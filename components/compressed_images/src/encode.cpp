// SPDX-License-Identifier: Apache-2.0
#include "panvo/compressed_images/encode.hpp"

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>

#include "jpeg.hpp"
#include "panvo/conversions/image.hpp"
#include "png.hpp"

namespace panvo::compressed_images {
namespace {

using conversions::Reason;
using conversions::Result;
using sensor_msgs::msg::CompressedImage;
using sensor_msgs::msg::Image;

jpeg::Order order_of(const cv::Mat& pixels, bool is_rgb) {
  switch (pixels.channels()) {
    case 1:
      return jpeg::Order::kGrey;
    case 3:
      return is_rgb ? jpeg::Order::kRgb : jpeg::Order::kBgr;
    default:
      return is_rgb ? jpeg::Order::kRgba : jpeg::Order::kBgra;
  }
}

/// Converts to BGR order, as png::encode() requires.
cv::Mat in_bgr_order(const cv::Mat& pixels, bool is_rgb) {
  if (!is_rgb) return pixels;
  cv::Mat bgr;
  cv::cvtColor(pixels, bgr, pixels.channels() == 4 ? cv::COLOR_RGBA2BGRA : cv::COLOR_RGB2BGR);
  return bgr;
}

}  // namespace

Result<std::shared_ptr<const CompressedImage>> encode(const Image& image, const Encoding& encoding) {
  const auto pixels = conversions::view(image);
  if (!pixels) return Reason{pixels.reason()};
  const bool is_jpeg = encoding.kind == Encoding::Kind::kJpeg;
  if (is_jpeg && pixels->depth() != CV_8U)
    return Reason{"has 16 bits per pixel, which JPEG does not support: choose png"};
  const bool is_rgb = image.encoding().starts_with("rgb");
  auto message = std::make_shared<CompressedImage>();
  message->header(image.header());
  message->format(fmt::format("{}; {} compressed {}", image.encoding(), is_jpeg ? "jpeg" : "png",
                              pixels->channels() == 1 ? "" : "bgr8"));
  if (is_jpeg) {
    message->data(jpeg::encode(pixels->data, pixels->cols, pixels->rows, pixels->step, order_of(*pixels, is_rgb),
                               encoding.jpeg_quality));
  } else {
    message->data(png::encode(in_bgr_order(*pixels, is_rgb), encoding.png_level));
  }
  return std::shared_ptr<const CompressedImage>(std::move(message));
}

}  // namespace panvo::compressed_images
