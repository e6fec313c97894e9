// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "panvo/landmarks/keypoints.hpp"
#include "panvo/landmarks/landmark_distance.hpp"
#include "panvo/landmarks/landmark_library.hpp"
#include "panvo/landmarks/panorama_describer.hpp"
#include "panvo/position_corrector/panorama_pose.hpp"
#include "panvo/vision/stage_observer.hpp"
#include "panvo/vision/stamp_sequence.hpp"

namespace panvo::position_corrector {

/// Thresholds for recognising a landmark. Gates are in the paper's order, cheapest first; the last one, geometry,
/// decides.
struct MatchingParameters {
  double radius_m = 15.0;
  double radius_sigmas = 3.0;
  double max_histogram_distance = 0.6;  ///< T_h
  double max_large_distance = 0.95;     ///< T_fl
  double max_small_distance = 0.95;     ///< T_fs
  int max_compared = 200;
  int max_verified = 3;
  double window_m = 3.0;
  double window_s = 3.0;
  double leave_m = 30.0;
  PanoramaPoseParameters pose;

  template <class Field>
  static void describe(Field&& field) {
    using P = MatchingParameters;
    field(&P::radius_m, "radius_m", "m",
          "search radius for an exactly known position: distance at which a place can be recognised", 1.0, 1000.0);
    field(&P::radius_sigmas, "radius_sigmas", "1",
          "addition to the search radius, in standard deviations of the position", 0.0, 10.0);
    field(&P::max_histogram_distance, "max_histogram_distance", "1", "T_h [Lu2015 5.1]", 0.0, 1.0);
    field(&P::max_large_distance, "max_large_distance", "1",
          "T_fl, large-scale distance relative to its mean over all headings [Lu2015 5.1]; other places have 0.8 or "
          "more, the same place at night up to 0.92",
          0.0, 1.0);
    field(&P::max_small_distance, "max_small_distance", "1", "T_fs, the same for the small-scale features [Lu2015 5.1]",
          0.0, 1.0);
    field(&P::max_compared, "max_compared", "1",
          "largest number of candidates per panorama that are compared exactly; of more, the most similar ones by an "
          "approximate comparison",
          1, 1'000'000);
    field(&P::max_verified, "max_verified", "1",
          "largest number of candidates per panorama whose geometry is verified, most similar first", 1, 100);
    field(&P::window_m, "window_m", "m", "a minimum is final after this path without a smaller distance", 0.2, 50.0);
    field(&P::window_s, "window_s", "s", "or after this time, if the vehicle stands still", 0.1, 60.0);
    field(&P::leave_m, "leave_m", "m", "path before a landmark that was just built or matched is searched again", 0.0,
          1000.0);
    field.group(&P::pose, "pose");
  }
};

enum class MatchState {
  kSearching,  ///< no known landmark here
  kLocked,     ///< passing a landmark; its nearest point may be still ahead
  kMatched,    ///< passed: this panorama was the most similar one
  kRejected,   ///< a similar landmark failed the geometric verification
  kUnusable,   ///< the panorama cannot be evaluated
};

/// Predicted position of the vehicle in the map.
struct PositionPrior {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of base_link, m
  double sigma_m = 0.0;                                ///< horizontal, along the worst direction
};

/// A panorama and the vehicle's state at its stamp.
struct PanoramaFrame {
  std::int64_t stamp_ns = 0;
  cv::Mat panorama;          ///< CV_8UC1 or CV_8UC3, 2:1
  double travelled_m = 0.0;  ///< path length since the start
  std::optional<PositionPrior> prior;
};

/// D(f_s, f_ss) for one panorama of a pass [Lu2015 5.1, Fig. 7].
struct DistanceSample {
  double travelled_m = 0.0;  ///< path length since the start
  double distance = 1.0;     ///< relative, of the small-scale features, to the locked landmark
};

/// Data of a pass by a landmark, for the correction at its nearest point [Lu2015 5.2].
struct LandmarkPass {
  std::vector<DistanceSample> curve;           ///< of all its panoramas, in order
  std::vector<landmarks::Keypoint> keypoints;  ///< of the matched panorama
};

/// Result for one panorama, with intermediate values.
struct LandmarkMatch {
  MatchState state = MatchState::kSearching;
  std::string reason;         ///< of this state; empty when matched
  std::int64_t stamp_ns = 0;  ///< of the panorama described; when matched, an earlier one
  std::uint32_t landmark_id = 0;
  double heading_rad = 0.0;  ///< yaw now minus yaw at the landmark, left positive
  /// Distances to the landmark, NaN for levels that were not compared.
  double histogram_distance = std::numeric_limits<double>::quiet_NaN();
  double large_distance = std::numeric_limits<double>::quiet_NaN();
  double small_distance = std::numeric_limits<double>::quiet_NaN();
  int candidates = 0, kept_after_histogram = 0, kept_after_large = 0;  ///< the last two: of those compared exactly
  std::optional<PanoramaPose> pose;                                    ///< of the panorama relative to the landmark
  std::optional<PanoramaPose> weak_pose;  ///< instead of `pose`: one that needs confirmation
  int inliers = 0;                        ///< of the pose; when rejected, the largest number reached
  std::vector<PointMatch> points;         ///< what the panorama shows of the landmark's points; not when matched
  std::optional<LandmarkPass> pass;       ///< when matched
};

/// Recognises landmarks at any heading [Lu2015 5.1]. Candidates come from the position and its uncertainty, or are all
/// landmarks without a position. Levels: histogram; large-scale features at all headings; small-scale features by
/// Algorithm 1; and, beyond the paper, geometric verification with SIFT features, as one wrong match is worse than ten
/// missed ones. A recognised landmark is locked and followed until its distance D(f_s, f_ss) has passed its minimum.
class LandmarkMatcher {
 public:
  LandmarkMatcher(const MatchingParameters& matching, const landmarks::KeypointParameters& keypoints,
                  const landmarks::PanoramaDescriber& describer, vision::StageObserver* observer = nullptr);

  /// To be called for each landmark added to the library: one built on this journey is searched only after the vehicle
  /// has left it. Landmarks added before the first panorama are from earlier journeys.
  void added(std::uint32_t id);

  /// Keypoints are not taken from what the vehicle covers: 0 in `seen` (CV_8UC1, any size, for the whole panorama).
  void set_seen(const cv::Mat& seen) { seen_ = seen; }

  /// Processes frames in order of stamps. If the clock was set back, the lock is released.
  LandmarkMatch match(const PanoramaFrame& frame, const landmarks::LandmarkLibrary& library);

 private:
  struct Candidate {
    std::uint32_t id = 0;
    landmarks::PanoramaDescription description;
    float histogram_distance = 1.0F;
    landmarks::HeadingMatch large, small;
  };
  struct Lock {
    std::uint32_t landmark_id = 0;
    double heading_rad = 0.0;
    LandmarkMatch best;         ///< among those with a pose, the one with the smallest small-scale distance
    double min_distance = 1.0;  ///< smallest distance of all panoramas, with or without a pose
    double nearest_m = std::numeric_limits<double>::infinity();  ///< smallest offset of all poses
    double min_at_m = 0.0;                                       ///< where and when either was found
    std::int64_t min_at_ns = 0;
    LandmarkPass pass;  // with the keypoints of `best`
  };

  LandmarkMatch search(const PanoramaFrame& frame, const landmarks::QueryDescription& query,
                       const landmarks::LandmarkLibrary& library);
  LandmarkMatch follow(const PanoramaFrame& frame, const landmarks::QueryDescription& query,
                       const landmarks::LandmarkLibrary& library);
  /// Enters their number in the result.
  std::vector<Candidate> candidates(const PanoramaFrame& frame, const landmarks::QueryDescription& query,
                                    const landmarks::LandmarkLibrary& library, LandmarkMatch& match) const;
  /// Levels of the search, cheapest first. The first two return how many candidates were similar enough; of the second,
  /// only the most similar ones remain.
  int keep_similar_histograms(const landmarks::QueryDescription& query, std::vector<Candidate>& near) const;
  int keep_similar_at_large_scale(const landmarks::QueryDescription& query, std::vector<Candidate>& near) const;
  void sort_by_small_scale(const landmarks::QueryDescription& query, std::vector<Candidate>& near) const;
  /// Locks the first candidate whose geometry agrees; without one the match is rejected.
  void verify(const PanoramaFrame& frame, const landmarks::LandmarkLibrary& library, const std::vector<Candidate>& near,
              LandmarkMatch& match);
  /// Enters a candidate and its distances in the result.
  static void describe(const Candidate& candidate, LandmarkMatch& match);
  /// Landmarks that were just built or matched.
  std::set<std::uint32_t> not_left(double travelled_m) const;
  std::vector<landmarks::Keypoint> keypoints_of(const cv::Mat& panorama) const;

  const MatchingParameters parameters_;
  const landmarks::KeypointParameters keypoint_parameters_;
  const landmarks::PanoramaDescriber& describer_;
  vision::StageObserver* observer_;
  bool has_started_ = false;
  double travelled_m_ = 0.0;
  std::map<std::uint32_t, double> seen_at_m_;  ///< path length at which a landmark was last built or matched
  vision::StampSequence stamps_;
  std::optional<Lock> lock_;
  cv::Mat seen_;  // for keypoints; empty: all of the panorama
};

}  // namespace panvo::position_corrector
