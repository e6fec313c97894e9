// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace panvo::calibration {

/// A corner of the board as an image shows it.
struct Corner {
  int id = 0;             ///< of Board::point
  Eigen::Vector2d pixel;  ///< pixel centres at integer coordinates
};

/// What the cameras saw of the board at one moment.
struct View {
  std::string name;                       ///< of the images, without folder and ending
  std::vector<std::vector<Corner>> seen;  ///< a list for each camera; empty: not seen
  std::vector<std::string> missing = {};  ///< why a camera did not see it; empty text: it did
};

/// Everything that a calibration is made of.
struct Observations {
  std::vector<std::string> cameras;           ///< names
  std::vector<cv::Size> image_sizes;          ///< one for each camera
  std::vector<Eigen::Vector3d> board_points;  ///< by id, in the board's frame, m
  std::vector<View> views;
};

}  // namespace panvo::calibration
