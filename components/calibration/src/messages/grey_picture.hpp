// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "panvo/interfaces/message_type.hpp"

namespace panvo::calibration {

/// Converts a message of type Image or CompressedImage to a CV_8UC1 image that owns its pixels. Throws CalibrationError
/// that names `topic` if it cannot be decoded.
cv::Mat grey_picture(const std::string& topic, const interfaces::MessageType& type, const void* message);

}  // namespace panvo::calibration
