// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "panvo/landmark_builder/junction_filter.hpp"
#include "panvo/landmark_builder/keypoint_triangulation.hpp"
#include "panvo/landmark_builder/landmark_rule.hpp"
#include "panvo/landmark_builder/road_junction_detector.hpp"
#include "panvo/landmarks/keypoints.hpp"
#include "panvo/landmarks/map_replica.hpp"
#include "panvo/landmarks/panorama_describer.hpp"
#include "panvo/landmarks/panoramic_landmark.hpp"
#include "panvo/vision/pose.hpp"
#include "panvo/vision/stage_observer.hpp"

namespace panvo::landmark_builder {

struct BuilderParameters {
  JunctionDetectorParameters junction;
  JunctionFilterParameters filter;
  LandmarkRuleParameters rule;
  TriangulationParameters triangulation;
  landmarks::DescriptionParameters description;
  landmarks::KeypointParameters keypoints;
  int neighbours = 4;
  double max_neighbour_distance_m = 3.5;
  int thumbnail_quality = 60;

  template <class Field>
  static void describe(Field&& field) {
    using P = BuilderParameters;
    field.group(&P::junction, "junction");
    field.group(&P::filter, "filter");
    field.group(&P::rule, "rule");
    field.group(&P::triangulation, "triangulation");
    field.group(&P::description, "description");
    field.group(&P::keypoints, "keypoints");
    field(&P::neighbours, "neighbours", "1", "panoramas before and after a landmark's that triangulate its keypoints",
          0, 20);
    field(&P::max_neighbour_distance_m, "max_neighbour_distance_m", "m",
          "distance of the farthest of them from the landmark", 0.5, 50.0);
    field(&P::thumbnail_quality, "thumbnail_quality", "1", "JPEG quality of a landmark's thumbnail; 0: no thumbnail", 0,
          100);
  }
};

/// A panorama and the vehicle's pose at its stamp.
struct PosedPanorama {
  std::int64_t stamp_ns = 0;
  cv::Mat image;  ///< 8UC1 or 8UC3 (BGR), 2:1
  Eigen::Isometry3d odom_from_base = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Zero();  ///< of odom_from_base, as vision::pose_error
  /// Current pose of the odometry frame in the map: it drifts, and jumps at corrections, unlike odometry.
  Eigen::Isometry3d map_from_odom = Eigen::Isometry3d::Identity();
};

/// Builds panoramic landmarks along the path [Lu2015 4]: detects junctions, selects the panorama nearest to the centre
/// of a passed junction, describes it, and triangulates its keypoints with the panoramas around it.
class LandmarkBuilder {
 public:
  /// For panoramas of one camera and size. `seed` determines the measurement matrices. Throws like RoadJunctionDetector
  /// and PanoramaDescriber.
  LandmarkBuilder(const BuilderParameters& parameters, std::uint64_t seed, const Eigen::Isometry3d& base_from_panorama,
                  cv::Size panorama_size, vision::StageObserver* observer = nullptr);

  /// Processes panoramas in order of time; returns the landmarks completed, each built from an earlier panorama and
  /// added to the map with its next id. Panoramas rejected by landmarks::find_fault must not be passed.
  std::vector<landmarks::PanoramicLandmark> step(const PosedPanorama& panorama, landmarks::MapReplica& map);

  /// At the end of the path: builds the landmarks that still wait for the clock, as after `wait_for_clock_s`.
  std::vector<landmarks::PanoramicLandmark> finish(landmarks::MapReplica& map);

  /// The panoramas so far were taken at other times: replaces the poses of those that are kept for later landmarks, by
  /// stamp, and forgets panoramas without one.
  using PoseOf = std::function<std::optional<Eigen::Isometry3d>(std::int64_t stamp_ns)>;
  void set_poses(const PoseOf& odom_from_base);

  /// The poses of panoramas are those of the times at which they were taken: landmarks need not wait.
  void set_clock_known() { is_clock_known_ = true; }

  /// Keypoints are not taken from what the vehicle covers: 0 in `seen` (CV_8UC1, any size, for the whole panorama).
  void set_seen(const cv::Mat& seen) { seen_ = seen; }

  /// Reports that a landmark was recognised at the last panorama.
  void recognised() { rule_.recognised(travelled_m_); }

  /// Detector result for the last panorama.
  const JunctionView& view() const noexcept { return view_; }
  double travelled_m() const noexcept { return travelled_m_; }

 private:
  struct Kept {
    std::int64_t stamp_ns;
    cv::Mat grey, thumbnail;
    Eigen::Isometry3d odom_from_base;
    vision::Matrix6d covariance;
    double travelled_m;
  };

  /// A landmark to be built once the clock is known.
  struct Waiting {
    double travelled_m;  // of its panorama
    std::int64_t stamp_ns;
    bool is_junction;
  };

  void keep(const PosedPanorama& panorama);
  void build_waiting(landmarks::MapReplica& map, std::vector<landmarks::PanoramicLandmark>& built);
  bool is_taken(const Kept& chosen, const landmarks::MapReplica& map) const;
  bool has_waited(const Waiting& landmark, std::int64_t now_ns) const;
  bool is_due(const landmarks::MapReplica& map, double travelled_m) const;
  const Kept& nearest_to_stamp(std::int64_t stamp_ns) const;
  const Kept& nearest_to_travelled(double travelled_m) const;
  std::vector<const Kept*> neighbours_of(const Kept& chosen) const;
  std::optional<landmarks::PanoramicLandmark> build(const Kept& chosen, bool is_junction, landmarks::MapReplica& map);

  BuilderParameters parameters_;
  vision::StageObserver* observer_;
  Eigen::Isometry3d base_from_panorama_;
  RoadJunctionDetector detector_;
  JunctionFilter filter_;
  LandmarkRule rule_;
  landmarks::PanoramaDescriber describer_;
  JunctionView view_;
  Eigen::Isometry3d map_from_odom_ = Eigen::Isometry3d::Identity();
  std::deque<Kept> kept_;
  cv::Mat seen_;  // for keypoints; empty: all of the panorama
  std::optional<Eigen::Vector3d> last_position_;
  double travelled_m_ = 0.0;
  bool is_clock_known_ = false;  // of the panoramas
  std::deque<Waiting> waiting_;  // along the path
};

}  // namespace panvo::landmark_builder
