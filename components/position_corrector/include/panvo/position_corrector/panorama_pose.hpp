// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "panvo/landmarks/panoramic_landmark.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::position_corrector {

struct PanoramaPoseParameters {
  double azimuth_window_deg = 25.0;
  double descriptor_ratio = 0.85;
  double bearing_sigma_deg = 0.25;
  double inlier_angle_deg = 0.8;
  int iterations = 200;
  int min_inliers = 12;
  int min_weak_inliers = 7;
  double min_inliers_share = 0.25;
  int min_sectors = 4;
  double layer_m = 0.8;
  double max_turn_deg = 25.0;
  double max_tilt_deg = 20.0;
  double max_offset_m = 25.0;
  int spare_points = 2;

  template <class Field>
  static void describe(Field&& field) {
    using P = PanoramaPoseParameters;
    field(&P::azimuth_window_deg, "azimuth_window_deg", "deg",
          "largest azimuth error of a match after alignment by heading: heading error and parallax", 2.0, 180.0);
    field(&P::descriptor_ratio, "descriptor_ratio", "1",
          "largest ratio of a match's descriptor distance to the second best", 0.3, 1.0);
    field(&P::bearing_sigma_deg, "bearing_sigma_deg", "deg",
          "standard deviation of a keypoint's bearing: 0.75 px of 1080, for SIFT at half size", 0.01, 2.0);
    field(&P::inlier_angle_deg, "inlier_angle_deg", "deg",
          "largest angle between the bearing of an inlier and its matched point: three standard deviations", 0.05, 5.0);
    field(&P::iterations, "iterations", "1", "maximum number of RANSAC samples", 10, 10000);
    field(&P::min_inliers, "min_inliers", "1",
          "smallest number of inliers; other places of the same building style reach 10", 4, 1000);
    field(&P::min_weak_inliers, "min_weak_inliers", "1",
          "the same for a weak pose, which the next panorama and the expected position must confirm", 4, 1000);
    field(&P::min_inliers_share, "min_inliers_share", "1", "smallest fraction of inliers among the matched points", 0.0,
          1.0);
    field(&P::min_sectors, "min_sectors", "1",
          "smallest number of sectors, of twelve per turn, with inliers: a single building may repeat elsewhere", 1,
          12);
    field(
        &P::layer_m, "layer_m", "m",
        "thickness of a horizontal layer: of the inliers needed, half must lie outside the two fullest ones, as roofs "
        "with their beams, floors and rows of pillars repeat at equal distances; 0: no such test",
        0.0, 10.0);
    field(&P::max_turn_deg, "max_turn_deg", "deg",
          "largest difference between the pose's heading and that of the compressive features", 1.0, 180.0);
    field(&P::max_tilt_deg, "max_tilt_deg", "deg", "largest tilt of the vehicle relative to the landmark", 1.0, 90.0);
    field(&P::max_offset_m, "max_offset_m", "m", "largest distance of a pose from the landmark", 1.0, 200.0);
    field(&P::spare_points, "spare_points", "1",
          "inliers that may be false: the covariance is that without the most informative ones, as a near point alone "
          "determines a position among far ones",
          0, 100);
  }
};

/// Pose of a panorama relative to a landmark's panorama.
struct PanoramaPose {
  Eigen::Isometry3d landmark_from_panorama = Eigen::Isometry3d::Identity();  ///< panorama frames, m
  vision::Matrix6d covariance = vision::Matrix6d::Zero();                    ///< as vision::pose_error
  double heading_rad = 0.0;  ///< yaw now minus yaw at the landmark, left positive, (-pi, pi]
};

/// A point of the landmark, and where the panorama shows what was matched with it.
struct PointMatch {
  Eigen::Vector3d point = Eigen::Vector3d::UnitZ();    ///< m, frame of the landmark's panorama
  Eigen::Vector3d bearing = Eigen::Vector3d::UnitZ();  ///< unit, frame of the panorama
  bool agrees = false;                                 ///< with the pose; false if there is none
};

struct PanoramaPoseResult {
  std::optional<PanoramaPose> pose;
  std::optional<PanoramaPose> weak_pose;  ///< instead of `pose` when it has few inliers
  int matches = 0;                        ///< keypoints matched with points of the landmark
  int inliers = 0;                        ///< of these, inliers of one pose
  std::vector<PointMatch> points;         ///< those that agree with the pose first
  std::string reason;                     ///< why there is no pose; else empty
};

/// Pose with six degrees of freedom, in metres, from the landmark's points and their current bearings: matches near the
/// heading found by the compressive features, three-point RANSAC on the sphere, then refinement over the inliers,
/// weighting each point by its own uncertainty. Unlike the paper's five-point motion [Lu2015 5.2] it determines the
/// distance. Deterministic.
PanoramaPoseResult estimate_panorama_pose(std::span<const landmarks::Keypoint> panorama,
                                          std::span<const landmarks::Keypoint> landmark, double heading_rad,
                                          const PanoramaPoseParameters& parameters);

/// Yaw of a panorama relative to another, rad, left positive, (-pi, pi]; frames X right, Y down, Z forward.
double heading_of(const Eigen::Matrix3d& landmark_from_panorama);

}  // namespace panvo::position_corrector
