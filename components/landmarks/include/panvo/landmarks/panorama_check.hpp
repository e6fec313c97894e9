// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace panvo::landmarks {

/// Reason, with numbers, why a panorama cannot be described; nullopt if it can. Detects panoramas that are empty, not
/// CV_8UC1 or CV_8UC3, not 2:1, too small, black, saturated, constant, or covered over more than a third of the full
/// turn.
std::optional<std::string> find_fault(const cv::Mat& panorama);

}  // namespace panvo::landmarks
