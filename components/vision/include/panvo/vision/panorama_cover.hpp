// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

namespace panvo::vision {

/// The share of the full turn, [0, 1], whose columns show nothing between two rows (as shares of the height): what covers the camera there
/// is even. Of a panorama of CV_8UC1 or CV_8UC3, by a sparse grid.
double covered_share(const cv::Mat& panorama, double from_row, double to_row);

}  // namespace panvo::vision
