// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace panvo::landmarks {

/// Why nothing can be said about the place that a panorama shows, in numbers; nullopt when it can be described.
/// Found are: empty, not CV_8UC1 or CV_8UC3, not twice as wide as high, too small, black, saturated, constant, and a view that
/// is covered over more than a third of the full turn.
std::optional<std::string> find_fault(const cv::Mat& panorama);

}  // namespace panvo::landmarks
