// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace panvo::vision {

/// Returns why an image (CV_8UC1) is unusable: empty, black, saturated or constant, with figures; nullopt if it is
/// usable. Samples the grey levels on a sparse grid.
std::optional<std::string> find_fault(const cv::Mat& image);

}  // namespace panvo::vision
