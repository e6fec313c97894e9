// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "panvo/calibration/board.hpp"
#include "panvo/calibration/observations.hpp"

namespace panvo::calibration {

/// Appearance of the board in one image, used to compare views for a calibration.
struct BoardLook {
  Eigen::Vector2d middle;  ///< mean of the corners, as fractions of the image width and height
  double size = 0.0;       ///< square root of the fraction of the image area that the whole board would cover
  /// Foreshortening. x: positive if the height is reduced (tilted forwards or back), negative if the width is reduced
  /// (tilted to the left or right); y: along a diagonal. The norm is sin^2 t / (1 + cos^2 t) for a tilt t: 0.14 at
  /// 30 degrees, 0.33 at 45.
  Eigen::Vector2d slant;
};

/// Computed from the least-squares affine map from board to image. Returns nullopt for fewer than three corners, or if
/// they are collinear on the board or in the image.
std::optional<BoardLook> look_of(const std::vector<Corner>& corners, const Board& board, const cv::Size& image_size);

/// Sum of the differences in position, size (logarithmic) and slant. 0.2 corresponds to a shift by a fifth of the image
/// width, to 1.65 times the distance, or to a tilt of 35 degrees instead of 0.
double difference(const BoardLook& a, const BoardLook& b);

}  // namespace panvo::calibration
