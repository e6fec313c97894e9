// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

namespace panvo::vision {

/// Share of columns, [0, 1], that are uniform between two rows (given as fractions of the height), i.e. covered. The
/// panorama (CV_8UC1 or CV_8UC3) is sampled on a sparse grid.
double covered_share(const cv::Mat& panorama, double from_row, double to_row);

}  // namespace panvo::vision
