// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/corner_detector.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace panvo::vision {
namespace {
constexpr int kBlock = 5;  // px of the half-size image: about the size of the tracked patch
}

CellGrid::CellGrid(cv::Size image_size, int cell_px)
    : cell_px_(cell_px),
      columns_((image_size.width + cell_px - 1) / cell_px),
      rows_((image_size.height + cell_px - 1) / cell_px),
      taken_(static_cast<size_t>(columns_ * rows_), false) {}

size_t CellGrid::cell(const Eigen::Vector2d& pixel) const {
  const int column = std::clamp(static_cast<int>(pixel.x()) / cell_px_, 0, columns_ - 1);
  const int row = std::clamp(static_cast<int>(pixel.y()) / cell_px_, 0, rows_ - 1);
  return static_cast<size_t>(row * columns_ + column);
}

int CellGrid::free_cells() const { return static_cast<int>(std::count(taken_.begin(), taken_.end(), false)); }

std::vector<Corner> detect_corners(const ImagePyramid& image, const CellGrid& grid, double min_gradient,
                                   int margin_px) {
  if (image.levels() == 0) return {};
  const int level = std::min(1, image.levels() - 1);
  const double scale = 1 << level;
  const cv::Mat& half = image[level];
  cv::Mat eigenvalues;
  cv::cornerMinEigenVal(half, eigenvalues, kBlock, 3, cv::BORDER_REPLICATE);
  // OpenCV scales 8-bit images so that a mean square gradient g^2 gives the eigenvalue (2 g / 255)^2.
  const double threshold = std::pow(2.0 * min_gradient / 255.0, 2);

  const int margin = static_cast<int>(std::ceil(margin_px / scale));
  const double cell = grid.cell_px() / scale;
  std::vector<Corner> corners;
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      if (!grid.is_free({(column + 0.5) * grid.cell_px(), (row + 0.5) * grid.cell_px()})) continue;
      const cv::Point from(std::max(margin, static_cast<int>(std::ceil(column * cell))),
                           std::max(margin, static_cast<int>(std::ceil(row * cell))));
      const cv::Point to(std::min(half.cols - margin, static_cast<int>(std::ceil((column + 1) * cell))),
                         std::min(half.rows - margin, static_cast<int>(std::ceil((row + 1) * cell))));
      if (from.x >= to.x || from.y >= to.y) continue;
      double strongest = 0.0;
      cv::Point place;
      cv::minMaxLoc(eigenvalues(cv::Rect(from, to)), nullptr, &strongest, nullptr, &place);
      if (strongest < threshold || strongest <= 0.0) continue;
      corners.push_back(
          {scale * Eigen::Vector2d(from.x + place.x, from.y + place.y), 0.5 * 255.0 * std::sqrt(strongest)});
    }
  }
  return corners;
}

}  // namespace panvo::vision
