// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace panvo::vision {

/// The rectangle of a filter in a band of a panorama: x in [0, columns) and width up to columns, so it may cross the seam.
struct BandRectangle {
  int x = 0;
  int y = 0;
  int width = 1;
  int height = 1;

  bool operator==(const BandRectangle&) const = default;
};

/// Sums of the SURF descriptor over a rectangle: dx, |dx|, dy, |dy| [Lu2015 3.2].
using GradientStatistics = std::array<float, 4>;

/// Integral images of a band that goes all the way round: of the intensity, and of the gradients' dx, |dx|, dy, |dy|. They are
/// padded beyond the seam, so the rectangles of a feature, seen at any heading, are the same ones at an offset: nothing is rotated,
/// resampled or computed again.
class CyclicIntegralImages {
 public:
  CyclicIntegralImages() = default;

  /// Of a band (CV_8UC1, at least 3 rows and 3 columns, else std::invalid_argument), whose columns are a full turn, for
  /// rectangles of at most `widest` columns (0: any). Gradients are those of Sobel's filter, scaled to grey levels per px;
  /// beyond the upper and lower border the image goes on as its last row.
  explicit CyclicIntegralImages(const cv::Mat& band, int widest = 0);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  int widest() const { return static_cast<int>(stride_) - 1 - columns_; }  ///< rectangle that can be read, px

  /// Mean of the band's pixels in a rectangle [Lu2015 Eq. 2]. A mean, not a sum: size does not weigh.
  float mean_intensity(const BandRectangle& rectangle) const;
  /// Means of dx, |dx|, dy, |dy|, grey levels per px.
  GradientStatistics mean_gradients(const BandRectangle& rectangle) const;

 private:
  friend class ResponseReader;

  std::ptrdiff_t at(int x, int y) const { return static_cast<std::ptrdiff_t>(y) * stride_ + x; }

  int columns_ = 0;
  int rows_ = 0;
  std::ptrdiff_t stride_ = 0;            // cells a row: columns + widest + 1
  std::vector<std::int32_t> intensity_;  // (rows + 1) x stride, the sum of all pixels above and to the left
  std::vector<std::int32_t> gradients_;  // the same, four a cell
};

}  // namespace panvo::vision
