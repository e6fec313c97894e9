// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "panvo/panoramic_compass/distance_curve.hpp"
#include "panvo/vision/adaptive_selection.hpp"
#include "panvo/vision/compressive_features.hpp"
#include "panvo/vision/cyclic_integral_images.hpp"
#include "panvo/vision/measurement_matrix.hpp"

namespace panvo::panoramic_compass {

/// A full-turn band of a panorama (CV_8UC1), prepared for compressive features.
struct FeatureBand {
  vision::CyclicIntegralImages images;
  vision::BandNormalisation normalisation;

  /// `widest`: largest rectangle width, px.
  FeatureBand(const cv::Mat& band, int widest);
};

/// Parameters for drawing and selecting the features of a patch.
struct FeaturePatchParameters {
  int drawn = 100;
  int rectangles = 4;  ///< per row; equal numbers of plus and minus signs, so that brightness cancels
  vision::RectangleBounds bounds;
  vision::SelectionParameters selection;
};

/// A patch of a band, described by adaptive compressive features, and its distance to positions in another band of the
/// same size [Lu2015 6].
class FeaturePatch {
 public:
  /// `place`: px, within the rows of the band; x is cyclic. Throws std::invalid_argument if the rectangles do not fit
  /// into it.
  FeaturePatch(cv::Size band, const cv::Rect& place, const FeaturePatchParameters& parameters, std::uint64_t seed);

  /// Selects the features that distinguish the patch from its surroundings [Lu2015 Eqs. 6-8].
  void describe(const FeatureBand& band);

  bool is_described() const { return !features_.empty(); }
  int widest() const { return matrix_.widest(); }

  /// D for the displacements (first ... first + count - 1, dv) px [Lu2015 Eq. 11]. The paper does not define d; it is
  /// min(1, |difference of the responses| / spread), averaged with the weights h. 1 without features.
  DistanceCurve distances(const FeatureBand& band, int first, int count, int dv = 0) const;

 private:
  vision::MeasurementMatrix matrix_;
  vision::SelectionParameters selection_;
  std::uint64_t seed_;
  vision::BandNormalisation
      normalisation_;  // of the described band; that of another band also depends on new objects in view
  std::vector<vision::SelectedFeature> features_;
};

}  // namespace panvo::panoramic_compass
