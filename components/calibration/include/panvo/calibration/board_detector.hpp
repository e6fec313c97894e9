// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "panvo/calibration/board.hpp"
#include "panvo/calibration/observations.hpp"

namespace panvo::calibration {

class CharucoDetector;

/// The corners found in one image, or the reason why there are none.
struct Sighting {
  std::vector<Corner> corners;
  std::string missing;  ///< why there are no corners; empty if there are
};

/// Detects a board and refines its corners to sub-pixel accuracy. A chessboard must be fully visible, a ChArUco board
/// partly.
class BoardDetector {
 public:
  /// Throws CalibrationError for a dictionary that is unknown or too small.
  explicit BoardDetector(const Board& board);
  ~BoardDetector();

  /// `grey`: CV_8UC1.
  Sighting detect(const cv::Mat& grey) const;

 private:
  Sighting detect_chessboard(const cv::Mat& grey) const;
  Sighting detect_charuco(const cv::Mat& grey) const;
  bool is_reversed(const cv::Mat& grey, const std::vector<cv::Point2f>& corners) const;

  Board board_;
  std::unique_ptr<CharucoDetector> charuco_;  ///< kCharuco only
};

}  // namespace panvo::calibration
