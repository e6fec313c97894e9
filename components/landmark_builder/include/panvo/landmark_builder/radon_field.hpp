// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace panvo::landmark_builder {

/// The Radon transform of a road mask [Lu2015 4.1]: how much road each straight line runs over. Rows are the lines'
/// directions, over half a turn, counter-clockwise from "up" in the mask; columns their signed distances from its middle.
struct RadonField {
  cv::Mat lengths_m;  ///< 32FC1
  double direction_step_rad = 0.0;
  double offset_step_m = 0.0;
  int middle_offset() const { return lengths_m.cols / 2; }
};

/// `mask` 8UC1, square; only every second pixel is counted where `resolution_m` is fine enough.
RadonField radon_transform(const cv::Mat& mask, double resolution_m, int directions);

struct RadonPeak {
  double direction_rad = 0.0;  ///< [0, pi)
  double offset_m = 0.0;
  double length_m = 0.0;
};

/// Its local maxima: at least `share` of the highest, and no two closer in direction than `separation_rad`: what a wide or
/// bent road shows several times is one direction. Highest first.
std::vector<RadonPeak> local_maxima(const RadonField& field, double share, double separation_rad);

}  // namespace panvo::landmark_builder
