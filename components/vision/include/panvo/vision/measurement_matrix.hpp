// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <vector>

#include "panvo/vision/cyclic_integral_images.hpp"

namespace panvo::vision {

/// Range of rectangle sizes, px: from (inclusive) to (exclusive).
struct RectangleBounds {
  cv::Size from;
  cv::Size to;
};

/// Bounds of [Lu2015 4.2] for a band w x h: large h/8 <= height < h, w/20 <= width < w; small h/10 <= height < h/8,
/// w/40 <= width < w/20. `widest` (fraction of w) lowers the upper bound of the large widths: rectangles wider than a
/// fifth of the turn vary little between places, and most of them are affected by any partial occlusion.
RectangleBounds large_scale(cv::Size band, double widest = 1.0);
RectangleBounds small_scale(cv::Size band);

struct MatrixParameters {
  int rows = 200;      ///< number of patches
  int rectangles = 4;  ///< non-zero elements per row: s = m/4 leaves 4 on average [Lu2015 Eq. 3]
  bool balanced =
      false;            ///< equal numbers of plus and minus signs, so that brightness cancels; false: independent signs
  double spread = 1.0;  ///< range of the rectangle centres of a row, as a fraction of the full turn; 1: anywhere
};

/// Very sparse random matrix R that projects the responses of all rectangle filters of a band to a few compressive
/// features [Lu2015 Eqs. 1-5]. Only the non-zero elements of the (w h)^2 columns are stored: each row is a few
/// rectangles, each with the sign of [Eq. 3] and the selection among the four SURF statistics of [Eqs. 4, 5].
class MeasurementMatrix {
 public:
  struct Element {
    BandRectangle rectangle;
    float sign = 1.0F;                            ///< r_ij / sqrt(s): 1 or -1
    std::array<float, 4> statistics{1, 0, 0, 0};  ///< r-bar: 1 for each used one of dx, |dx|, dy, |dy|; at least one
    float share = 0.0F;                           ///< 1 / rectangle area; set by the matrix
  };

  MeasurementMatrix() = default;

  /// Draws the matrix: log-uniform sizes, uniform positions; the same seed gives the same matrix on every machine.
  /// Throws std::invalid_argument if the bounds do not fit into the band or a parameter is out of range.
  MeasurementMatrix(cv::Size band, const RectangleBounds& bounds, const MatrixParameters& parameters,
                    std::uint64_t seed);

  /// From given rows. Throws std::invalid_argument for a row without elements or a rectangle outside the band.
  MeasurementMatrix(cv::Size band, const std::vector<std::vector<Element>>& rows);

  cv::Size band() const { return band_; }
  int rows() const { return static_cast<int>(begins_.size()) - 1; }
  std::span<const Element> row(int index) const;
  int widest() const;  ///< largest rectangle width, px

 private:
  void finish_row();

  cv::Size band_;
  std::vector<Element> elements_;
  std::vector<std::size_t> begins_{0};  // first element of each row, and the end
};

}  // namespace panvo::vision
