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

/// A band of a panorama (CV_8UC1, a full turn), ready for compressive features to be read from it.
struct FeatureBand {
  vision::CyclicIntegralImages images;
  vision::BandNormalisation normalisation;

  /// `widest`: of the rectangles that will be read, px.
  FeatureBand(const cv::Mat& band, int widest);
};

/// How the features of a patch are drawn and chosen.
struct FeaturePatchParameters {
  int drawn = 100;
  int rectangles = 4;  ///< of a row, as many with a plus as with a minus: brightness cancels
  vision::RectangleBounds bounds;
  vision::SelectionParameters selection;
};

/// A patch of a band, described by adaptive compressive features, and how different it is from what lies at other places of
/// another band of the same size [Lu2015 6].
class FeaturePatch {
 public:
  /// `place`: px, within the rows of the band; x may lie beyond its ends. Throws std::invalid_argument where the rectangles
  /// have no room in it.
  FeaturePatch(cv::Size band, const cv::Rect& place, const FeaturePatchParameters& parameters, std::uint64_t seed);

  /// Chooses the features that tell the patch from its surroundings [Lu2015 Eqs. 6-8].
  void describe(const FeatureBand& band);

  bool is_described() const { return !features_.empty(); }
  int widest() const { return matrix_.widest(); }

  /// D of displacements (first ... first + count - 1, dv) [Lu2015 Eq. 11], px: the mean, weighted by h, of
  /// min(1, |difference of the responses| / spread), where the paper leaves d open; 1 without features.
  DistanceCurve distances(const FeatureBand& band, int first, int count, int dv = 0) const;

 private:
  vision::MeasurementMatrix matrix_;
  vision::SelectionParameters selection_;
  std::uint64_t seed_;
  vision::BandNormalisation normalisation_;  // of the band described; another's differs by what came into view, too
  std::vector<vision::SelectedFeature> features_;
};

}  // namespace panvo::panoramic_compass
