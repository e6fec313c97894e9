// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <string>

#include "panvo/conversions/result.hpp"
#include "sensor_msgs/msg/Image.h"

/// Images of messages as OpenCV images, without copying a pixel where that can be.
/// Encodings: mono8, mono16, rgb8, bgr8, rgba8, bgra8; 8UC1, 8UC3 and 16UC1 read as mono8, bgr8 and mono16.
namespace panvo::conversions {

/// The message's pixels as they are, not copied: valid as long as the message, and not to be written to. The reason
/// says what is wrong with encoding, size, step or data.
Result<cv::Mat> view(const sensor_msgs::msg::Image& image);

/// 8-bit grey: a view as above of a grey image, a conversion of its own of any other (16 bits: scaled).
Result<cv::Mat> grey(const sensor_msgs::msg::Image& image);

/// 8-bit grey or BGR, whichever it holds: a view as above of mono8 and bgr8, a conversion of its own of any other.
Result<cv::Mat> grey_or_bgr(const sensor_msgs::msg::Image& image);

/// A message with room for the pixels, to be written through pixels() and then published; rows follow without gaps.
/// Throws std::invalid_argument for an encoding that is not one of the above or a size that is not positive.
std::shared_ptr<sensor_msgs::msg::Image> make_image(std::int64_t stamp_ns, const std::string& frame_id,
                                                    const std::string& encoding, int width, int height);

/// The pixels of a message that is being made; writing to it writes to the message. Throws std::invalid_argument
/// where view() has a reason.
cv::Mat pixels(sensor_msgs::msg::Image& image);

/// The encoding of an OpenCV type: mono8, mono16, bgr8, bgra8. Throws std::invalid_argument for any other.
std::string encoding_of(int opencv_type);

}  // namespace panvo::conversions
