// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/aruco/charuco.hpp>

#include "panvo/calibration/board.hpp"

namespace panvo::calibration {

/// OpenCV's ChArUco board; X right and Y down, as printed. Throws CalibrationError for a dictionary that is unknown or
/// too small.
cv::Ptr<cv::aruco::CharucoBoard> charuco_board(const Board& board);

}  // namespace panvo::calibration
