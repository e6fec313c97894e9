// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <opencv2/core.hpp>
#include <string>

#include "panvo/conversions/image.hpp"

namespace panvo::compressed_images {

constexpr std::int64_t kStampNs = 1'700'000'000'123'456'789;

/// A smooth image with different gradients in each channel, so that swapped channels are detected.
inline std::shared_ptr<sensor_msgs::msg::Image> picture(const std::string& encoding, int width = 64, int height = 48) {
  auto image = conversions::make_image(kStampNs, "left_camera", encoding, width, height);
  cv::Mat pixels = conversions::pixels(*image);
  const int channels = pixels.channels();
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      for (int channel = 0; channel < channels; ++channel) {
        const double value = 128 + 100 * std::sin(0.05 * (channel + 1) * column + 0.07 * row);
        if (pixels.depth() == CV_16U) {
          pixels.ptr<std::uint16_t>(row)[column * channels + channel] =
              static_cast<std::uint16_t>(value * 250 + column);
        } else {
          pixels.ptr<std::uint8_t>(row)[column * channels + channel] = static_cast<std::uint8_t>(value);
        }
      }
    }
  }
  return image;
}

/// Largest difference of two images' pixel bytes; -1 if size or encoding differ.
inline int max_difference(const sensor_msgs::msg::Image& one, const sensor_msgs::msg::Image& other) {
  if (one.encoding() != other.encoding() || one.width() != other.width() || one.height() != other.height()) return -1;
  int largest = 0;
  for (std::size_t i = 0; i < one.data().size(); ++i) {
    largest = std::max(largest, std::abs(int{one.data()[i]} - int{other.data()[i]}));
  }
  return largest;
}

}  // namespace panvo::compressed_images
