// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <string>

#include "panvo/conversions/result.hpp"
#include "sensor_msgs/msg/Image.h"

/// Conversion of image messages to OpenCV images, without a copy if possible.
/// Encodings: mono8, mono16, rgb8, bgr8, rgba8, bgra8; 8UC1, 8UC3 and 16UC1 read as mono8, bgr8 and mono16.
namespace panvo::conversions {

/// View of the message's pixels without a copy: valid as long as the message, read-only. The reason states what is
/// wrong with encoding, size, step, byte order or data.
Result<cv::Mat> view(const sensor_msgs::msg::Image& image);

/// 8-bit grey: a view of an 8-bit grey image, a converted copy of any other (16-bit images are scaled).
Result<cv::Mat> grey(const sensor_msgs::msg::Image& image);

/// 8-bit grey or BGR, depending on the message: a view of mono8 and bgr8, a converted copy of any other encoding.
Result<cv::Mat> grey_or_bgr(const sensor_msgs::msg::Image& image);

/// Allocates a message with contiguous rows, to be filled through pixels() and then published.
/// Throws std::invalid_argument for an unsupported encoding or a size that is not positive.
std::shared_ptr<sensor_msgs::msg::Image> make_image(std::int64_t stamp_ns, const std::string& frame_id,
                                                    const std::string& encoding, int width, int height);

/// Writable view of the message's pixels. Throws std::invalid_argument where view() returns a reason.
cv::Mat pixels(sensor_msgs::msg::Image& image);

/// Encoding of an OpenCV type: mono8, mono16, bgr8, bgra8. Throws std::invalid_argument for other types.
std::string encoding_of(int opencv_type);

}  // namespace panvo::conversions
