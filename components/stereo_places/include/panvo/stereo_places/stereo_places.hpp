// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "panvo/landmarks/description_settings.hpp"
#include "panvo/landmarks/landmark_library.hpp"
#include "panvo/landmarks/landmark_store.hpp"
#include "panvo/position_corrector/landmark_matcher.hpp"
#include "panvo/position_corrector/position_correction.hpp"
#include "panvo/position_corrector/spilled_landmarks.hpp"
#include "panvo/stereo_places/disparity_offset.hpp"
#include "panvo/stereo_places/place_search.hpp"
#include "panvo/stereo_places/sighting_run.hpp"
#include "panvo/stereo_places/view_keypoints.hpp"
#include "panvo/stereo_places/view_picture.hpp"
#include "panvo/vision/camera.hpp"
#include "panvo/vision/stage_observer.hpp"

namespace panvo::stereo_places {

/// When views are compared, and when they become places.
struct PlaceRule {
  double step_m = 1.0;
  double step_deg = 8.0;
  double step_s = 0.4;
  double min_shared = 0.45;
  double nearby_m = 2.0;
  double nearby_deg = 15.0;
  double leave_m = 30.0;
  double correction_m = 8.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = PlaceRule;
    field(&P::step_m, "step_m", "m", "path after which the next view is compared", 0.05, 100.0);
    field(&P::step_deg, "step_deg", "deg", "or turn", 0.5, 90.0);
    field(&P::step_s, "step_s", "s", "least time between two compared views: limits the computing time", 0.0, 60.0);
    field(&P::min_shared, "min_shared", "1",
          "a view becomes a place when it shares less than this with the last place, built or recognised: neighbouring "
          "places overlap, so that one of them is always seen at a similar scale",
          0.05, 0.95);
    field(&P::nearby_m, "nearby_m", "m", "no second place within this distance ...", 0.0, 100.0);
    field(&P::nearby_deg, "nearby_deg", "deg", "... and this angle", 0.0, 180.0);
    field(&P::leave_m, "leave_m", "m", "path before a place that was just built is searched again", 0.0, 1000.0);
    field(&P::correction_m, "correction_m", "m",
          "path between two corrections that agree with the expected pose: the errors of neighbouring ones are alike",
          0.0, 1000.0);
  }
};

struct Parameters {
  PlaceRule rule;
  ViewKeypointParameters keypoints;
  SearchParameters search;
  RunParameters run;

  template <class Field>
  static void describe(Field&& field) {
    using P = Parameters;
    field.group(&P::rule, "rule");
    field.group(&P::keypoints, "keypoints");
    field.group(&P::search, "search");
    field.group(&P::run, "run");
  }
};

/// Settings of the landmarks of stereo views: they are not comparable with panoramas.
landmarks::DescriptionSettings view_settings(const ViewKeypointParameters& parameters);

/// Pose of the vehicle in the map at a view.
struct MapPose {
  Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Zero();
  bool is_located = true;  ///< false: the place in a stored map is unknown yet
};

/// A rectified pair and the vehicle's state at its stamp.
struct StereoView {
  std::int64_t stamp_ns = 0;
  cv::Mat left, right;  ///< CV_8UC1
  Eigen::Isometry3d odom_from_base = Eigen::Isometry3d::Identity();
  double way_m = 0.0;  ///< path length since the start
  MapPose pose;
};

struct ViewResult {
  position_corrector::LandmarkMatch match;
  std::optional<position_corrector::LandmarkMatch> passed;  ///< a landmark whose pass this view ended
  std::optional<position_corrector::PositionCorrection> correction;
  std::optional<landmarks::PanoramicLandmark> built;
  std::string not_built;  ///< why a view that was needed as a place is none; else empty
};

/// Builds places from the left image of a stereo pair, with points in metres from its disparities, and recognises them at
/// like headings.
class StereoPlaces {
 public:
  /// `base_from_left`: extrinsics of the left rectified camera. `keypoints`: where those of the landmarks are kept.
  StereoPlaces(const Parameters& parameters, const vision::RectifiedStereo& stereo,
               const Eigen::Isometry3d& base_from_left, std::shared_ptr<position_corrector::SpilledLandmarks> keypoints,
               vision::StageObserver* observer = nullptr);

  /// A landmark of an earlier journey or another node. False if it is known already: then its pose is updated.
  bool add(landmarks::PanoramicLandmark landmark);
  /// Updates the pose of a landmark; false if it is unknown.
  bool set_pose(const landmarks::LandmarkPose& pose);

  /// Whether the view at this moment is to be passed to step(). Its stamp is before the last one only if the clock was
  /// set back.
  bool is_due(std::int64_t stamp_ns, const Eigen::Isometry3d& odom_from_base, double way_m) const;

  /// Compares a view with the places, and builds one from it if it shows too little of any. `next_id`: lower ids are
  /// taken, by landmarks that are unknown here as well.
  ViewResult step(const StereoView& view, std::uint32_t next_id = 1);

  std::size_t size() const noexcept { return library_.size(); }

 private:
  /// The last place, built or recognised, and where its camera was.
  struct Reference {
    std::vector<Eigen::Vector3d> points;
    Eigen::Isometry3d odom_from_view;
  };
  struct Compared {  // the last view passed to step()
    std::int64_t stamp_ns;
    Eigen::Isometry3d odom_from_base;
    double way_m;
    std::vector<landmarks::Keypoint> keypoints;
  };

  SearchResult search(const StereoView& view, const std::vector<landmarks::Keypoint>& keypoints) const;
  void recognise(const StereoView& view, const FoundPlace& place, ViewResult& result);
  std::optional<position_corrector::PositionCorrection> correct(const StereoView& view, const FoundPlace& place,
                                                                const position_corrector::BasePose& pose);
  void end_pass(ViewResult& result);
  bool is_new_place(const StereoView& view) const;
  void build(const StereoView& view, std::uint32_t next_id, std::vector<landmarks::Keypoint> keypoints,
             ViewResult& result);
  void set_reference(const Eigen::Isometry3d& odom_from_view, const std::vector<landmarks::Keypoint>& keypoints);
  void keep(landmarks::PanoramicLandmark landmark);

  Parameters parameters_;
  vision::RectifiedStereo stereo_;
  Eigen::Isometry3d base_from_left_;
  vision::StageObserver* observer_;
  ViewPicture picture_;
  ViewDepths depths_;
  DisparityOffset offset_;
  std::shared_ptr<position_corrector::SpilledLandmarks> keypoints_;
  landmarks::LandmarkLibrary library_;
  PlaceSearch search_;
  SightingRun run_;
  std::optional<Compared> last_;
  std::optional<Reference> reference_;
  std::map<std::uint32_t, double> built_at_m_;  // path length at which a landmark of this journey was built
  std::optional<double> corrected_at_m_;
  bool is_expected_ = true;                                // the last confirmed sighting agreed with the expected pose
  std::optional<position_corrector::LandmarkMatch> pass_;  // the best view of the landmark that is being passed
};

}  // namespace panvo::stereo_places
