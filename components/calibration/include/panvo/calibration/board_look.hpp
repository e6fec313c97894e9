// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "panvo/calibration/board.hpp"
#include "panvo/calibration/observations.hpp"

namespace panvo::calibration {

/// How a camera sees the board at one moment, so far as it matters to a calibration whether another view is like it.
struct BoardLook {
  Eigen::Vector2d middle;  ///< of the corners seen, in shares of the image's width and height
  double size = 0.0;       ///< square root of the share of the image that the whole board would cover there
  /// Which way it is foreshortened. First: positive where it looks low (tilted forwards or back), negative where it
  /// looks narrow (turned to the left or right); second: along which diagonal. Tilted by t, the length is
  /// sin^2 t / (1 + cos^2 t): 0.14 at 30 degrees, 0.33 at 45.
  Eigen::Vector2d slant;
};

/// From the affine map that fits the corners best. nullopt: fewer than three corners, or all on one line on
/// the board or in the image.
std::optional<BoardLook> look_of(const std::vector<Corner>& corners, const Board& board, const cv::Size& image_size);

/// The sum of how far place, size (by its logarithm) and slant differ; 0.2: a fifth of the image's width to the side, or a board 1.65 times as
/// far away, or one tilted by 35 degrees instead of none.
double difference(const BoardLook& a, const BoardLook& b);

}  // namespace panvo::calibration
