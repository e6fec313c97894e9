// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "panvo/vision/cyclic_integral_images.hpp"
#include "panvo/vision/measurement_matrix.hpp"

namespace panvo::vision {

/// Gain and offset of a band's grey levels, and the gain of its gradients: what exposure and clouds change and features must not
/// depend on. Applied to responses, not to pixels.
struct BandNormalisation {
  float offset = 0.0F;           ///< grey levels
  float intensity_scale = 1.0F;  ///< grey levels
  float gradient_scale = 1.0F;   ///< grey levels per px

  /// Of a band (CV_8UC1) and its integral images: mean and deviation of its grey levels, and the mean absolute gradient.
  static BandNormalisation of(const cv::Mat& band, const CyclicIntegralImages& images);
};

/// One patch: a row of the measurement matrix, applied to the intensity [Lu2015 Eqs. 1-3] and to the SURF statistics
/// [Lu2015 Eqs. 4, 5].
struct CompressiveFeature {
  float intensity = 0.0F;
  float gradient = 0.0F;
};

/// Reads features of a matrix from a band, its rectangles displaced by (du, dv) px: du any number of columns, dv so that they
/// stay within the band's rows (clamped a rectangle). Refers to its arguments.
class ResponseReader {
 public:
  ResponseReader(const CyclicIntegralImages& images, const MeasurementMatrix& matrix,
                 const BandNormalisation& normalisation)
      : images_(images), matrix_(matrix), normalisation_(normalisation) {}

  CompressiveFeature read(int row, int du = 0, int dv = 0) const;
  float read_intensity(int row, int du = 0, int dv = 0) const;
  float read_gradient(int row, int du = 0, int dv = 0) const;

 private:
  const CyclicIntegralImages& images_;
  const MeasurementMatrix& matrix_;
  const BandNormalisation& normalisation_;
};

}  // namespace panvo::vision
