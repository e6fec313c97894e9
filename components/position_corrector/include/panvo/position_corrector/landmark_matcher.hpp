// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "panvo/landmarks/keypoints.hpp"
#include "panvo/landmarks/landmark_distance.hpp"
#include "panvo/landmarks/landmark_library.hpp"
#include "panvo/landmarks/panorama_describer.hpp"
#include "panvo/position_corrector/panorama_pose.hpp"
#include "panvo/vision/stage_observer.hpp"

namespace panvo::position_corrector {

/// When a panorama is taken for a landmark. Gates come in the paper's order, each cheaper than the next; the last, geometry, decides.
struct MatchingParameters {
  double radius_m = 15.0;
  double radius_sigmas = 3.0;
  double largest_histogram_distance = 0.6;  ///< T_h
  double largest_large_distance = 0.85;     ///< T_fl
  double largest_small_distance = 0.9;      ///< T_fs
  int most_verified = 3;
  double window_m = 3.0;
  double window_s = 3.0;
  double leave_m = 30.0;
  PanoramaPoseParameters pose;

  template <class Field>
  static void describe(Field&& field) {
    using P = MatchingParameters;
    field(&P::radius_m, "radius_m", "m",
          "landmarks this near are candidates however sure the position is: from how far a place can be recognised",
          1.0, 1000.0);
    field(&P::radius_sigmas, "radius_sigmas", "1", "and those within so many standard deviations of the position more",
          0.0, 10.0);
    field(&P::largest_histogram_distance, "largest_histogram_distance", "1", "T_h [Lu2015 5.1]", 0.0, 1.0);
    field(&P::largest_large_distance, "largest_large_distance", "1",
          "T_fl, of the large-scale features, of their mean over all headings [Lu2015 5.1]: other places have 0.9 +- "
          "0.05",
          0.0, 1.0);
    field(&P::largest_small_distance, "largest_small_distance", "1",
          "T_fs, of the small-scale features, the same way [Lu2015 5.1]", 0.0, 1.0);
    field(&P::most_verified, "most_verified", "1",
          "candidates, the most similar, whose geometry is looked at in one panorama", 1, 100);
    field(&P::window_m, "window_m", "m", "a smallest distance is the smallest once nothing smaller came over this way",
          0.2, 50.0);
    field(&P::window_s, "window_s", "s", "or over this time, should the vehicle stand", 0.1, 60.0);
    field(&P::leave_m, "leave_m", "m",
          "way to be driven before a landmark that was built or matched just now is looked for again", 0.0, 1000.0);
    field.group(&P::pose, "pose");
  }
};

enum class MatchState {
  kSearching,  ///< no landmark is known here
  kLocked,     ///< the vehicle passes a landmark; its nearest point may still come
  kMatched,    ///< it has passed: this was the panorama most similar to the landmark
  kRejected,   ///< something looked like a landmark and is none
  kUnusable,   ///< nothing can be said of this panorama
};

/// Where the vehicle is about to be, in the map.
struct PositionPrior {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of base_link, m
  double sigma_m = 0.0;                                ///< horizontal, along the worst direction
};

/// A panorama and what is known of the vehicle at its time.
struct PanoramaFrame {
  std::int64_t stamp_ns = 0;
  cv::Mat panorama;          ///< CV_8UC1 or CV_8UC3, 2:1
  double travelled_m = 0.0;  ///< way since the start
  std::optional<PositionPrior> prior;
};

/// D(f_s, f_ss) at one panorama of a pass [Lu2015 5.1, Fig. 7].
struct DistanceSample {
  double travelled_m = 0.0;  ///< way since the start
  double distance = 1.0;     ///< relative, of the small-scale features, to the locked landmark
};

/// What was kept of a pass by a landmark, for the correction at its nearest point [Lu2015 5.2].
struct LandmarkPass {
  std::vector<DistanceSample> curve;           ///< of all its panoramas, in their order
  std::vector<landmarks::Keypoint> keypoints;  ///< of the panorama that was matched
};

/// What a panorama shows of the landmarks, and how it came to that.
struct LandmarkMatch {
  MatchState state = MatchState::kSearching;
  std::string reason;         ///< why this state; empty when matched
  std::int64_t stamp_ns = 0;  ///< of the panorama it is about: when matched, one of those before
  std::uint32_t landmark_id = 0;
  double heading_rad = 0.0;  ///< yaw now minus then, left positive
  /// Of the landmark, as far as the levels were compared; else not a number.
  double histogram_distance = std::numeric_limits<double>::quiet_NaN();
  double large_distance = std::numeric_limits<double>::quiet_NaN();
  double small_distance = std::numeric_limits<double>::quiet_NaN();
  int candidates = 0, kept_after_histogram = 0, kept_after_large = 0;
  std::optional<PanoramaPose> pose;       ///< where it was taken, seen from the landmark
  std::optional<PanoramaPose> weak_pose;  ///< instead of it: one that must not stand alone
  int inliers = 0;  ///< keypoints that agree on the pose, or the most that did where geometry rejected it
  std::optional<LandmarkPass> pass;  ///< when matched
};

/// Recognises landmarks at any heading [Lu2015 5.1]: candidates by the position and its uncertainty, or all where there is none; histogram;
/// large-scale features at all headings; small-scale ones by Algorithm 1; and, beyond the paper, the geometry of the SIFT
/// features as the judge: one wrong match is worse than ten missed ones. A landmark that passes is locked, and followed until its
/// distance D(f_s, f_ss) has had its minimum.
class LandmarkMatcher {
 public:
  LandmarkMatcher(const MatchingParameters& matching, const landmarks::KeypointParameters& keypoints,
                  const landmarks::PanoramaDescriber& describer, vision::StageObserver* observer = nullptr);

  /// To be called for landmarks as they are added to the library: one that was built on this journey is not looked for
  /// before the vehicle has left it. Those that are there before the first panorama are of earlier journeys.
  void added(std::uint32_t id);

  /// Frames in order of stamps.
  LandmarkMatch match(const PanoramaFrame& frame, const landmarks::LandmarkLibrary& library);

 private:
  struct Candidate {
    const landmarks::PanoramicLandmark* landmark = nullptr;
    float histogram_distance = 1.0F;
    landmarks::HeadingMatch large, small;
  };
  struct Lock {
    std::uint32_t landmark_id = 0;
    double heading_rad = 0.0;
    LandmarkMatch best;  ///< of those with a pose, the one of the smallest small-scale distance
    /// Of all, the smallest distance, and where it was: on the way to it poses may be missing.
    double smallest_distance = 1.0;
    double smallest_at_m = 0.0;
    std::int64_t smallest_at_ns = 0;
    LandmarkPass pass;  // with the keypoints of `best`
  };

  LandmarkMatch search(const PanoramaFrame& frame, const landmarks::QueryDescription& query,
                       const landmarks::LandmarkLibrary& library);
  LandmarkMatch follow(const PanoramaFrame& frame, const landmarks::QueryDescription& query,
                       const landmarks::LandmarkLibrary& library);
  std::vector<Candidate> candidates(const PanoramaFrame& frame, const landmarks::LandmarkLibrary& library) const;
  bool is_left(std::uint32_t id, double travelled_m) const;
  std::vector<landmarks::Keypoint> keypoints_of(const cv::Mat& panorama) const;

  const MatchingParameters parameters_;
  const landmarks::KeypointParameters keypoint_parameters_;
  const landmarks::PanoramaDescriber& describer_;
  vision::StageObserver* observer_;
  bool has_started_ = false;
  double travelled_m_ = 0.0;
  std::map<std::uint32_t, double> seen_at_m_;  ///< where on the way a landmark was built or matched last
  std::optional<Lock> lock_;
};

}  // namespace panvo::position_corrector
