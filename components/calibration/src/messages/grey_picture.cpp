// SPDX-License-Identifier: Apache-2.0
#include "grey_picture.hpp"

#include <fmt/format.h>

#include <opencv2/imgcodecs.hpp>

#include "panvo/calibration/calibration_error.hpp"
#include "panvo/conversions/image.hpp"
#include "sensor_msgs/msg/CompressedImage.h"
#include "sensor_msgs/msg/Image.h"

namespace panvo::calibration {

using sensor_msgs::msg::CompressedImage;
using sensor_msgs::msg::Image;

cv::Mat grey_picture(const std::string& topic, const interfaces::MessageType& type, const void* message) {
  if (&type == &interfaces::message_type<Image>()) {
    const auto grey = conversions::grey(*static_cast<const Image*>(message));
    if (!grey) throw CalibrationError(fmt::format("{}: an image {}", topic, grey.reason()));
    return grey->clone();
  }
  const auto& compressed = *static_cast<const CompressedImage*>(message);
  cv::Mat grey = compressed.data().empty() ? cv::Mat() : cv::imdecode(compressed.data(), cv::IMREAD_GRAYSCALE);
  if (grey.empty())
    throw CalibrationError(
        fmt::format("{}: an image of format '{}' cannot be decompressed", topic, compressed.format()));
  return grey;
}

}  // namespace panvo::calibration
