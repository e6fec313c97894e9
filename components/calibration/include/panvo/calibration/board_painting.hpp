// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "panvo/calibration/board.hpp"

namespace panvo::calibration {

/// A black or white rectangle of a board. Later patches cover earlier ones.
struct Patch {
  cv::Rect2d area_m;  ///< in the board's frame
  bool is_black = true;
};

/// Squares and markers of the board, in painting order. Throws CalibrationError for a dictionary that is unknown or too
/// small.
std::vector<Patch> paint(const Board& board);

/// The board as SVG in true size (print at 100 %), with a white margin of one square.
std::string draw_board(const Board& board);

}  // namespace panvo::calibration
