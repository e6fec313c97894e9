// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "panvo/vision/image_pyramid.hpp"

namespace panvo::vision {

/// Square cells over an image, each free or taken: spreads features evenly.
class CellGrid {
 public:
  CellGrid(cv::Size image_size, int cell_px);

  size_t cell(const Eigen::Vector2d& pixel) const;  ///< row by row
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

/// A place whose neighbourhood can be found again in both directions of the image.
struct Corner {
  Eigen::Vector2d position;  ///< px
  double gradient = 0.0;  ///< grey levels per px of the half-size image, root mean square along the weakest direction
};

/// The strongest corner of each free cell [Shi and Tomasi 1994], row by row, with a gradient of at least `smallest_gradient`
/// and at least `margin_px` from the border. Corners are sought in the half-size image: what is textured there can be
/// followed over the levels of the pyramid, and the exact place of a feature is of no importance.
std::vector<Corner> detect_corners(const ImagePyramid& image, const CellGrid& grid, double smallest_gradient,
                                   int margin_px);

}  // namespace panvo::vision
