// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <memory>
#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <vector>

#include "panvo/landmarks/keypoints.hpp"
#include "panvo/landmarks/panorama_describer.hpp"
#include "panvo/position_corrector/five_point_motion.hpp"
#include "panvo/position_corrector/landmark_matcher.hpp"

namespace panvo::python {

struct PlaceParameters {
  landmarks::DescriptionParameters description;
  landmarks::KeypointParameters keypoints;
  position_corrector::MatchingParameters matching;
  position_corrector::FivePointParameters geometry;

  template <class Field>
  static void describe(Field&& field) {
    using P = PlaceParameters;
    field.group(&P::description, "description");
    field.group(&P::keypoints, "keypoints");
    field.group(&P::matching, "matching");
    field.group(&P::geometry, "geometry");
  }
};

/// A described panorama. `basis`: of the describer; only descriptions with equal parameters and seed are comparable.
struct Place {
  landmarks::PanoramaDescription description;
  std::vector<landmarks::Keypoint> keypoints;
  std::shared_ptr<const landmarks::DescriptionBasis> basis;
};

struct PlaceMatch {
  bool is_known = false;
  std::size_t index = 0;  ///< of the place, if known
  std::string reason;     ///< why unknown; else empty
  /// Of the known place, or of the most similar one (NaN without any).
  double heading_rad = std::numeric_limits<double>::quiet_NaN();  ///< yaw now minus yaw at the place, left positive
  double distance = std::numeric_limits<double>::quiet_NaN();     ///< relative, 0 (same panorama) to about 1
  int inliers = 0;                                                ///< keypoints that agree on one motion
};

/// Recognises places by the panorama alone, without metric points: the levels of LandmarkMatcher, then the paper's
/// five-point motion as verification [Lu2015 5.2].
class PlaceRecogniser {
 public:
  /// Throws std::invalid_argument for parameters that contradict each other.
  PlaceRecogniser(const PlaceParameters& parameters, std::uint64_t seed);

  /// Throws std::invalid_argument with the reason for an unusable panorama.
  Place describe(const cv::Mat& panorama) const;

  /// An unusable panorama is an unknown place, with the reason. Throws std::invalid_argument for places described with
  /// other parameters.
  PlaceMatch match(const cv::Mat& panorama, std::span<const Place* const> places) const;

 private:
  const PlaceParameters parameters_;
  const std::uint64_t seed_;
  const landmarks::PanoramaDescriber describer_;
};

}  // namespace panvo::python
