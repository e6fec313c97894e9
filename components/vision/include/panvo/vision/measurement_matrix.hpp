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

/// Sizes that a filter's rectangles may have, px: from (inclusive) to (exclusive).
struct RectangleBounds {
  cv::Size from;
  cv::Size to;
};

/// [Lu2015 4.2] of a band w x h: large h/8 <= height < h, w/20 <= width < w; small h/10 <= height < h/8, w/40 <= width < w/20.
/// `widest`, of w, lowers the upper bound of the large widths: what spans more than a fifth of the full turn changes little
/// from place to place, and whatever covers a part of the view touches most of such rectangles.
RectangleBounds large_scale(cv::Size band, double widest = 1.0);
RectangleBounds small_scale(cv::Size band);

struct MatrixParameters {
  int rows = 200;         ///< patches drawn
  int rectangles = 4;     ///< non-zero elements of a row: s = m/4 leaves 4 on average [Lu2015 Eq. 3]
  bool balanced = false;  ///< as many plus as minus signs, so that brightness cancels, instead of each drawn by itself
  double spread = 1.0;    ///< how far the centres of a row's rectangles lie apart, of a full turn; 1: anywhere
};

/// Very sparse random matrix R that takes the responses of all rectangle filters of a band to a few compressive features
/// [Lu2015 Eqs. 1-5]. Its (w h)^2 columns are never stored: a row is the handful of rectangles where it is not zero, each with
/// the sign of [Eq. 3] and, for the SURF statistics, the choice among the four of [Eqs. 4, 5].
class MeasurementMatrix {
 public:
  struct Element {
    BandRectangle rectangle;
    float sign = 1.0F;                            ///< r_ij / sqrt(s): 1 or -1
    std::array<float, 4> statistics{1, 0, 0, 0};  ///< r-bar: 1 where dx, |dx|, dy, |dy| enters; at least one does
    float share = 0.0F;                           ///< of one pixel in the rectangle's mean; filled in by the matrix
  };

  MeasurementMatrix() = default;

  /// Draws the matrix, the same from the same seed on every machine; sizes evenly on a logarithmic scale, places evenly. Throws std::invalid_argument for a band that has no room
  /// for the bounds, or parameters out of range.
  MeasurementMatrix(cv::Size band, const RectangleBounds& bounds, const MatrixParameters& parameters,
                    std::uint64_t seed);

  /// Of given rows, each with at least one element, inside the band.
  MeasurementMatrix(cv::Size band, const std::vector<std::vector<Element>>& rows);

  cv::Size band() const { return band_; }
  int rows() const { return static_cast<int>(begins_.size()) - 1; }
  std::span<const Element> row(int index) const;
  int widest() const;  ///< rectangle, px

 private:
  void finish_row();

  cv::Size band_;
  std::vector<Element> elements_;
  std::vector<std::size_t> begins_{0};  // of each row's elements, and the end
};

}  // namespace panvo::vision
