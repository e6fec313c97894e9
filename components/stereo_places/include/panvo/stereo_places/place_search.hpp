// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "panvo/landmarks/landmark_library.hpp"
#include "panvo/position_corrector/panorama_pose.hpp"
#include "panvo/stereo_places/place_ranking.hpp"
#include "panvo/stereo_places/view_evidence.hpp"
#include "panvo/vision/camera.hpp"
#include "panvo/vision/stage_observer.hpp"

namespace panvo::stereo_places {

struct SearchParameters {
  double radius_m = 15.0;
  double radius_sigmas = 3.0;
  double max_turn_deg = 60.0;
  int max_verified = 4;
  int max_verified_unlocated = 8;
  double max_offset_m = 15.0;
  double max_tilt_deg = 25.0;
  double bearing_sigma_px = 0.8;
  double inlier_sigmas = 4.0;
  int iterations = 300;
  int min_inliers = 15;
  double min_inliers_share = 0.3;
  EvidenceParameters evidence;

  template <class Field>
  static void describe(Field&& field) {
    using P = SearchParameters;
    field(&P::radius_m, "radius_m", "m",
          "search radius for an exactly known position: distance at which a place can be recognised", 1.0, 1000.0);
    field(&P::radius_sigmas, "radius_sigmas", "1",
          "addition to the search radius and to the heading, in standard deviations", 0.0, 10.0);
    field(&P::max_turn_deg, "max_turn_deg", "deg", "largest difference of the headings of view and place", 1.0, 180.0);
    field(&P::max_verified, "max_verified", "1", "largest number of places per view whose geometry is verified", 1,
          100);
    field(&P::max_verified_unlocated, "max_verified_unlocated", "1", "the same while the position is unknown", 1, 100);
    field(&P::max_offset_m, "max_offset_m", "m", "largest distance of a view from the place", 1.0, 200.0);
    field(&P::max_tilt_deg, "max_tilt_deg", "deg", "largest tilt of the camera relative to the place", 1.0, 90.0);
    field(&P::bearing_sigma_px, "bearing_sigma_px", "px",
          "standard deviation of a keypoint in the image that is searched", 0.05, 10.0);
    field(&P::inlier_sigmas, "inlier_sigmas", "1", "largest error of an inlier, in these", 1.0, 20.0);
    field(&P::iterations, "iterations", "1", "maximum number of RANSAC samples", 10, 10000);
    field(&P::min_inliers, "min_inliers", "1", "smallest number of inliers", 4, 1000);
    field(&P::min_inliers_share, "min_inliers_share", "1", "smallest fraction of inliers among the matched points", 0.0,
          1.0);
    field.group(&P::evidence, "evidence");
  }
};

/// A place that a view shows.
struct FoundPlace {
  const landmarks::PanoramicLandmark* landmark = nullptr;
  position_corrector::PanoramaPose pose;  ///< of the view relative to the place
  int inliers = 0;
  ViewEvidence evidence;
};

struct SearchResult {
  std::optional<FoundPlace> place;
  std::string reason;         ///< why there is none; else empty
  std::uint32_t nearest = 0;  ///< place that came closest; 0: none was compared
  int candidates = 0;         ///< places near the position
  int verified = 0;           ///< of these, compared by geometry
};

/// What is known of the camera's pose in the map.
struct ViewPrior {
  Eigen::Isometry3d map_from_view = Eigen::Isometry3d::Identity();
  double sigma_m = 0.0;    ///< horizontal
  double sigma_rad = 0.0;  ///< of the heading
};

/// Finds the place that a view shows: ranking by descriptors, then geometry, then evidence against chance.
class PlaceSearch {
 public:
  /// `reduction`: factor by which images are reduced before keypoints are detected.
  PlaceSearch(const SearchParameters& parameters, const vision::PinholeCamera& camera, int reduction,
              vision::StageObserver* observer = nullptr);

  /// For each landmark added to the library.
  void add(const landmarks::PanoramicLandmark& landmark);

  /// `first`: a place that is compared first, and preferred to others that the view shows as well. `is_asked`: further
  /// condition on places.
  SearchResult find(std::span<const landmarks::Keypoint> view, const landmarks::LandmarkLibrary& library,
                    const std::optional<ViewPrior>& prior, std::optional<std::uint32_t> first,
                    const std::function<bool(std::uint32_t)>& is_asked) const;

 private:
  bool is_near(const landmarks::PanoramicLandmark& landmark, const ViewPrior& prior) const;
  /// The result's place if it agrees; else the reason.
  std::optional<FoundPlace> verify(std::span<const landmarks::Keypoint> view,
                                   const landmarks::PanoramicLandmark& landmark,
                                   std::span<const landmarks::Keypoint> keypoints, double log10_places,
                                   std::string& reason) const;

  SearchParameters parameters_;
  position_corrector::PanoramaPoseParameters pose_;
  double field_of_view_rad_;
  PlaceRanking ranking_;
  vision::StageObserver* observer_;
};

}  // namespace panvo::stereo_places
