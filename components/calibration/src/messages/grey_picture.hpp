// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "panvo/interfaces/message_type.hpp"

namespace panvo::calibration {

/// The picture in a message of type Image or CompressedImage, CV_8UC1, its pixels its own. Throws CalibrationError, naming `topic`, for one that
/// cannot be read.
cv::Mat grey_picture(const std::string& topic, const interfaces::MessageType& type, const void* message);

}  // namespace panvo::calibration
