// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <optional>

namespace panvo::vision {

/// Whole-pixel disparity in [from, to] with the best zero-mean normalised correlation between the 8x8 window around
/// `pixel` in `left` and the window `rows_below` rows lower in `right`. Returns nullopt if the best correlation is
/// below `min_correlation` or ambiguous, or if a window leaves its image or has too little contrast.
std::optional<int> search_row(const cv::Mat& left, const cv::Mat& right, cv::Point pixel, int rows_below, int from,
                              int to, double min_correlation);

}  // namespace panvo::vision
