// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "panvo/all_round_odometry/panorama_points.hpp"
#include "panvo/all_round_odometry/resection.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::all_round_odometry {

/// Motion of the vehicle since the panorama before.
struct PanoramicStep {
  Eigen::Isometry3d before_from_now = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Zero();  ///< without the error of the scale
  double scale_variance = 0.0;  ///< relative, common to the steps since distances were measured
  double agreeing_share = 0.0;  ///< of the points
};

/// Measures the motion between panoramas, in metres. While the motion is known, it learns the distances of the points;
/// while it is not, it finds the camera's pose among them. Points of a new reference panorama get their distances from
/// the motion that those of the reference before show, so that the scale is kept over any number of references, with a
/// growing error.
class PanoramicMotion {
 public:
  /// `base_from_camera`: position of the panoramic camera on the vehicle; bearings have the vehicle's axes.
  explicit PanoramicMotion(const Eigen::Vector3d& base_from_camera) : camera_(base_from_camera) {}

  /// Stamp of the panorama from which the next step counts: the last one, or the reference if nothing is known of it.
  std::int64_t before_ns(const PanoramaPoints& points) const;

  /// Share of the points of known distance that agree with a motion of the vehicle; nullopt if too few are known.
  std::optional<double> agreeing_share(const PanoramaPoints& points, const Eigen::Isometry3d& before_from_now) const;

  /// Processes a panorama of known motion: learns distances.
  void learn(const PanoramaPoints& points, const Eigen::Isometry3d& before_from_now);

  /// Processes a panorama of unknown motion; `expected_before_from_now`: start of the search. nullopt, as if there had
  /// been no panorama, if too few points agree, too few distances are known, or panoramas are missing.
  std::optional<PanoramicStep> measure(const PanoramaPoints& points, const Eigen::Isometry3d& expected_before_from_now);

 private:
  struct Point {
    InverseDistance inverse;
    int contradicted = 0;  // in a row
  };

  struct Reference {
    std::int64_t stamp_ns;
    Eigen::Isometry3d camera_from_local;
    int generation;         // 0: distances by measured motion; else by the motion that those of the one before showed
    double scale_variance;  // relative, of all distances alike
    std::map<int, Point> points;
  };

  bool goes_on(const PanoramaPoints& points) const;
  int leading_generation(const PanoramaPoints& points) const;
  std::vector<KnownSighting> known_sightings(const PanoramaPoints& points, int leading) const;
  Eigen::Isometry3d start_of_search(const PanoramaPoints& points,
                                    const Eigen::Isometry3d& expected_before_from_now) const;
  void rank_new_reference(int leading, const PanoramicStep& step);
  void take_references(const PanoramaPoints& points);
  void learn_distances(const PanoramaPoints& points);
  Eigen::Isometry3d camera_motion(const Eigen::Isometry3d& of_base) const;
  Eigen::Isometry3d base_motion(const Eigen::Isometry3d& of_camera) const;

  Eigen::Vector3d camera_;
  std::vector<Reference> references_;  // in order of stamps
  std::optional<std::int64_t> last_ns_;
  Eigen::Isometry3d local_from_last_ = Eigen::Isometry3d::Identity();  // of the camera
};

}  // namespace panvo::all_round_odometry
