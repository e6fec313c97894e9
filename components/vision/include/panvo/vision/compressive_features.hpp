// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/core/hal/intrin.hpp>

#include "panvo/vision/cyclic_integral_images.hpp"
#include "panvo/vision/measurement_matrix.hpp"

namespace panvo::vision {

/// Prepares a band (CV_8UC1, cyclic) for feature extraction: smooths it with a Gaussian of sigma 1 px, to suppress
/// pixel noise, and maps grey levels to a logarithmic scale. On that scale, local exposure changes and shadows are
/// offsets, which cancel in balanced features (as many plus as minus signs).
cv::Mat prepare_band(const cv::Mat& band);

/// Offset and gain of a band, to make features invariant to haze and clouds. Applied to responses, not to pixels.
struct BandNormalisation {
  float offset = 0.0F;           ///< grey levels
  float intensity_scale = 1.0F;  ///< grey levels
  float gradient_scale = 1.0F;   ///< grey levels per px

  /// Computed from a prepared band and its integral images: medians over sectors of the sector mean, standard deviation
  /// and mean absolute gradient. Robust to occlusion of up to half of the view.
  static BandNormalisation of(const cv::Mat& band, const CyclicIntegralImages& images);
};

/// Responses of one patch: a row of the measurement matrix applied to the intensity [Lu2015 Eqs. 1-3] and to the SURF
/// statistics [Lu2015 Eqs. 4, 5].
struct CompressiveFeature {
  float intensity = 0.0F;
  float gradient = 0.0F;
};

/// Evaluates the rows of a matrix on a band with the rectangles displaced by (du, dv) px. du is cyclic; dv is clamped
/// per rectangle to the rows of the band. Keeps references to `images` and `matrix`. Throws std::invalid_argument if
/// their band sizes differ or the matrix has wider rectangles than the integral images support.
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
