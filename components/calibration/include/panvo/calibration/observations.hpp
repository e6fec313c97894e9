// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace panvo::calibration {

/// A board corner in an image.
struct Corner {
  int id = 0;             ///< as in Board::point()
  Eigen::Vector2d pixel;  ///< pixel centres at integer coordinates
};

/// Corners that the cameras saw at one moment.
struct View {
  std::string name;                       ///< of the images, without folder and extension
  std::vector<std::vector<Corner>> seen;  ///< by camera; empty: not seen
  std::vector<std::string> missing = {};  ///< by camera: why the board was not seen; empty string if it was
};

/// Input of a calibration.
struct Observations {
  std::vector<std::string> cameras;           ///< names
  std::vector<cv::Size> image_sizes;          ///< by camera
  std::vector<Eigen::Vector3d> board_points;  ///< by id, in the board frame, m
  std::vector<View> views;
};

}  // namespace panvo::calibration
