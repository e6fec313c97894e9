// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "panvo/calibration/board.hpp"

namespace panvo::calibration {

/// A marker of a ChArUco board as printed: X right and Y down, m.
struct CharucoMarker {
  std::vector<cv::Point3f> corners;  ///< clockwise from the upper left one
  cv::Mat bits;                      ///< CV_8U; 0: black
};

/// Throws CalibrationError for a dictionary that is unknown or too small.
std::vector<CharucoMarker> charuco_markers(const Board& board);

/// OpenCV's detector of ChArUco boards, which is in another module from version 4.7 on.
class CharucoDetector {
 public:
  /// Throws like charuco_markers.
  explicit CharucoDetector(const Board& board);
  ~CharucoDetector();
  CharucoDetector(const CharucoDetector&) = delete;
  CharucoDetector& operator=(const CharucoDetector&) = delete;

  struct Found {
    std::size_t markers = 0;
    std::vector<int> ids;  ///< of the corners, row by row
    std::vector<cv::Point2f> corners;
  };
  /// `grey`: CV_8UC1.
  Found detect(const cv::Mat& grey) const;

 private:
  struct OpenCv;
  std::unique_ptr<OpenCv> opencv_;
};

}  // namespace panvo::calibration
