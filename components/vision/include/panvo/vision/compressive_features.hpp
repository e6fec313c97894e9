// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/core/hal/intrin.hpp>

#include "panvo/vision/cyclic_integral_images.hpp"
#include "panvo/vision/measurement_matrix.hpp"

namespace panvo::vision {

/// The band (CV_8UC1) that features are read from: smoothed by a Gaussian of 1 px, so that pixel noise does not pass for texture,
/// and on a logarithmic scale of grey levels. There, what exposure and shade do to a part of the view is an offset, and cancels
/// in every feature that has as many plus as minus signs, whatever happens in other parts. Cyclic, like the band.
cv::Mat prepare_band(const cv::Mat& band);

/// Offset and gain of a band: what haze and clouds change and features must not depend on. Applied to responses, not to pixels.
struct BandNormalisation {
  float offset = 0.0F;           ///< grey levels
  float intensity_scale = 1.0F;  ///< grey levels
  float gradient_scale = 1.0F;   ///< grey levels per px

  /// Of a prepared band and its integral images: medians over the sectors of the full turn of their mean, of their deviation and
  /// of their mean absolute gradient. Whatever covers less than half of the view leaves them nearly as they are.
  static BandNormalisation of(const cv::Mat& band, const CyclicIntegralImages& images);
};

/// One patch: a row of the measurement matrix, applied to the intensity [Lu2015 Eqs. 1-3] and to the SURF statistics
/// [Lu2015 Eqs. 4, 5].
struct CompressiveFeature {
  float intensity = 0.0F;
  float gradient = 0.0F;
};

/// Reads features of a matrix from a band, its rectangles displaced by (du, dv) px: du any number of columns, dv so that they
/// stay within the band's rows (clamped a rectangle). Refers to its arguments. Throws std::invalid_argument when matrix and
/// integral images are not of the same band or the matrix has wider rectangles than these were made for.
class ResponseReader {
 public:
  ResponseReader(const CyclicIntegralImages& images, const MeasurementMatrix& matrix,
                 const BandNormalisation& normalisation);

  CompressiveFeature read(int row, int du = 0, int dv = 0) const;
  float read_intensity(int row, int du = 0, int dv = 0) const;
  float read_gradient(int row, int du = 0, int dv = 0) const;

 private:
  struct Cell;
  Cell displace(const MeasurementMatrix::Element& element, int shift, int dv) const;
  float intensity_sum(const Cell& cell) const;
  cv::v_float32x4 gradient_sums(const Cell& cell) const;

  const CyclicIntegralImages& images_;
  const MeasurementMatrix& matrix_;
  BandNormalisation normalisation_;
  float per_intensity_, per_gradient_;  // 1 / scale
};

}  // namespace panvo::vision
