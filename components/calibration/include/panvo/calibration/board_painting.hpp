// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "panvo/calibration/board.hpp"

namespace panvo::calibration {

/// What of a board is black and what is white again upon it, in the order of painting.
struct Patch {
  cv::Rect2d area_m;  ///< in the board's frame
  bool is_black = true;
};

/// The board's squares and markers. Throws CalibrationError for a dictionary that is unknown or too small.
std::vector<Patch> paint(const Board& board);

/// The board as an SVG of its true size, to be printed at 100 %, with a white margin of one square.
std::string draw_board(const Board& board);

}  // namespace panvo::calibration
