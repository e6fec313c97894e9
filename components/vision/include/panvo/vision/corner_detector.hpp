// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "panvo/vision/image_pyramid.hpp"

namespace panvo::vision {

/// Grid of square cells, each free or taken; distributes features evenly over the image.
class CellGrid {
 public:
  CellGrid(cv::Size image_size, int cell_px);

  size_t cell(const Eigen::Vector2d& pixel) const;  ///< index in row-major order
  void take(const Eigen::Vector2d& pixel) { taken_[cell(pixel)] = true; }
  bool is_free(const Eigen::Vector2d& pixel) const { return !taken_[cell(pixel)]; }
  int free_cells() const;

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  int cell_px() const { return cell_px_; }

 private:
  int cell_px_;
  int columns_;
  int rows_;
  std::vector<bool> taken_;
};

/// A point whose neighbourhood has gradients in both image directions.
struct Corner {
  Eigen::Vector2d position;  ///< px
  double gradient = 0.0;     ///< RMS along the weakest direction, grey levels per px of the half-size image
};

/// Returns the strongest corner of each free cell [Shi and Tomasi 1994], in row-major order, with a gradient of at
/// least `min_gradient` and at least `margin_px` from the border. Detection runs on the half-size image: texture
/// there can be tracked through the pyramid, and the exact position of a corner does not matter.
std::vector<Corner> detect_corners(const ImagePyramid& image, const CellGrid& grid, double min_gradient, int margin_px);

}  // namespace panvo::vision
