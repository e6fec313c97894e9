// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace panvo::vision {

/// Filter rectangle in a band of a panorama, px: x in [0, columns), width up to columns; it may cross the seam.
struct BandRectangle {
  int x = 0;
  int y = 0;
  int width = 1;
  int height = 1;

  bool operator==(const BandRectangle&) const = default;
};

/// Sums of the SURF descriptor over a rectangle: dx, |dx|, dy, |dy| [Lu2015 3.2].
using GradientStatistics = std::array<float, 4>;

/// Integral images of a full-turn band: intensity, and dx, |dx|, dy, |dy| of the gradients. They are padded beyond the
/// seam, so a feature is evaluated at any heading by offsetting its rectangles, without rotating or resampling the
/// band.
class CyclicIntegralImages {
 public:
  CyclicIntegralImages() = default;

  /// `band`: CV_8UC1, at least 3 x 3 px (else std::invalid_argument); its columns cover a full turn. `widest`: largest
  /// rectangle width in columns (0: any). Gradients: Sobel filter, in grey levels per px; the first and last rows are
  /// replicated at the border.
  explicit CyclicIntegralImages(const cv::Mat& band, int widest = 0);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  int widest() const { return static_cast<int>(stride_) - 1 - columns_; }  ///< largest supported rectangle width, px

  /// Mean intensity in a rectangle [Lu2015 Eq. 2]. A mean, not a sum, so that all rectangle sizes weigh equally.
  float mean_intensity(const BandRectangle& rectangle) const;
  /// Means of dx, |dx|, dy, |dy|, grey levels per px.
  GradientStatistics mean_gradients(const BandRectangle& rectangle) const;

 private:
  friend class ResponseReader;

  std::ptrdiff_t at(int x, int y) const { return static_cast<std::ptrdiff_t>(y) * stride_ + x; }

  int columns_ = 0;
  int rows_ = 0;
  std::ptrdiff_t stride_ = 0;            // cells per row: columns + widest + 1
  std::vector<std::int32_t> intensity_;  // (rows + 1) x stride: sum of all pixels above and to the left
  std::vector<std::int32_t> gradients_;  // same layout, four values per cell
};

}  // namespace panvo::vision
