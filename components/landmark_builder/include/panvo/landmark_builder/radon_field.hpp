// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace panvo::landmark_builder {

/// The Radon transform of a road mask [Lu2015 4.1]: the length of road along each straight line. Rows are the lines'
/// directions over half a turn, counter-clockwise from "up" in the mask; columns are their signed distances from its
/// middle.
struct RadonField {
  cv::Mat lengths_m;  ///< 32FC1
  double direction_step_rad = 0.0;
  double offset_step_m = 0.0;
  int middle_offset() const { return lengths_m.cols / 2; }
};

/// `mask`: 8UC1, square. Uses every second pixel if `resolution_m` is below 0.4 m.
RadonField radon_transform(const cv::Mat& mask, double resolution_m, int directions);

struct RadonPeak {
  double direction_rad = 0.0;  ///< [0, pi)
  double offset_m = 0.0;
  double length_m = 0.0;
};

/// Local maxima of the field, highest first: at least `share` of the highest, and at least `separation_rad` apart in
/// direction, so that a wide or bent road counts as one direction.
std::vector<RadonPeak> local_maxima(const RadonField& field, double share, double separation_rad);

}  // namespace panvo::landmark_builder
