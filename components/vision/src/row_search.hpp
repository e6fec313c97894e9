// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <optional>

namespace panvo::vision {

/// Whole-pixel disparity in [from, to] whose 8x8 window in `right` correlates best (zero-mean, normalised) with the window
/// around `pixel` in `left`; the right image has it `rows_below` lower. nullopt where the best is under `smallest_correlation` or hardly better than another place.
std::optional<int> search_row(const cv::Mat& left, const cv::Mat& right, cv::Point pixel, int rows_below, int from,
                              int to, double smallest_correlation);

}  // namespace panvo::vision
