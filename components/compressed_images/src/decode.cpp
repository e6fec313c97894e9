// SPDX-License-Identifier: Apache-2.0
#include "panvo/compressed_images/decode.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <string_view>
#include <utility>

#include "jpeg.hpp"
#include "panvo/conversions/image.hpp"
#include "panvo/conversions/time.hpp"
#include "png.hpp"

namespace panvo::compressed_images {
namespace {

using conversions::Reason;
using conversions::Result;
using sensor_msgs::msg::CompressedImage;
using sensor_msgs::msg::Image;
using ImagePtr = std::shared_ptr<const Image>;

/// Empty if the size is acceptable. Limits memory, since a small file can state a huge size.
std::string size_problem(std::uint64_t width, std::uint64_t height) {
  constexpr std::uint64_t kMaxPixels = 100'000'000;
  constexpr std::uint64_t kMaxSide = 65'535;
  if (width > 0 && height > 0 && width <= kMaxSide && height <= kMaxSide && width * height <= kMaxPixels) {
    return "";
  }
  return fmt::format("states a size of {} x {} px; at most {} million are supported", width, height,
                     kMaxPixels / 1'000'000);
}

std::shared_ptr<Image> make_image(const CompressedImage& message, const char* encoding, int width, int height) {
  auto image = conversions::make_image(0, "", encoding, width, height);
  image->header(message.header());
  return image;
}

Result<ImagePtr> decode_jpeg(const CompressedImage& message, Output output) {
  const auto header = jpeg::read_header(message.data());
  if (!header) return Reason{header.reason()};
  if (auto problem = size_problem(header->width, header->height); !problem.empty()) return Reason{std::move(problem)};
  const bool is_grey = header->is_grey || output == Output::kMono8;
  const bool is_rgb = message.format().starts_with("rgb");
  auto image = make_image(message, is_grey ? "mono8" : is_rgb ? "rgb8" : "bgr8", header->width, header->height);
  const auto order = is_grey ? jpeg::Order::kGrey : is_rgb ? jpeg::Order::kRgb : jpeg::Order::kBgr;
  if (const auto problem = jpeg::decode(message.data(), *header, order, image->step(), image->data().data());
      !problem.empty()) {
    return Reason{"is a damaged JPEG file: " + problem};
  }
  return ImagePtr(std::move(image));
}

Result<ImagePtr> decode_png(const CompressedImage& message, Output output) {
  const auto header = png::read_header(message.data());
  if (!header) return Reason{header.reason()};
  if (auto problem = size_problem(header->width, header->height); !problem.empty()) return Reason{std::move(problem)};
  const auto file = png::decode(message.data());
  if (!file) return Reason{file.reason()};
  cv::Mat pixels = *file;
  if (output == Output::kMono8 && pixels.type() != CV_8UC1) {
    if (pixels.depth() == CV_16U) {
      pixels.convertTo(pixels, CV_8U, 1.0 / 257.0);
    } else {
      cv::cvtColor(pixels, pixels, pixels.channels() == 4 ? cv::COLOR_BGRA2GRAY : cv::COLOR_BGR2GRAY);
    }
  }
  auto image = make_image(message, conversions::encoding_of(pixels.type()).c_str(), pixels.cols, pixels.rows);
  cv::Mat target = conversions::pixels(*image);
  pixels.copyTo(target);
  return ImagePtr(std::move(image));
}

}  // namespace

Result<ImagePtr> decode(const CompressedImage& message, Output output) {
  if (jpeg::is_jpeg(message.data())) return decode_jpeg(message, output);
  if (png::is_png(message.data())) return decode_png(message, output);
  if (message.data().empty()) return Reason{"is empty"};
  return Reason{fmt::format("is neither a JPEG nor a PNG file (stated format: '{}'); set the driver to one of them",
                            message.format())};
}

}  // namespace panvo::compressed_images
