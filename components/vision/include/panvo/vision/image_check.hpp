// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace panvo::vision {

/// Why an image (CV_8UC1) shows nothing to work with, in numbers; nullopt when it does show something.
/// Found are: empty, black, saturated and constant images, by the grey levels of a sparse grid of pixels.
std::optional<std::string> find_fault(const cv::Mat& image);

}  // namespace panvo::vision
