// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>

#include "panvo/landmarks/panoramic_landmark.hpp"

namespace panvo::position_corrector {

/// Parameters of the paper's correction at the nearest point of a pass [Lu2015 5.2]; the paper leaves their values
/// open.
struct FivePointParameters {
  double azimuth_window_deg = 25.0;
  double descriptor_ratio = 0.8;
  double bearing_sigma_deg = 0.25;
  double inlier_angle_deg = 0.8;
  int iterations = 1000;
  int min_inliers = 20;
  double max_rotation_deg = 15.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = FivePointParameters;
    field(&P::azimuth_window_deg, "azimuth_window_deg", "deg",
          "largest azimuth error of a match after alignment by heading: heading error and parallax", 2.0, 180.0);
    field(&P::descriptor_ratio, "descriptor_ratio", "1",
          "largest ratio of a match's descriptor distance to the second best", 0.3, 1.0);
    field(&P::bearing_sigma_deg, "bearing_sigma_deg", "deg",
          "standard deviation of a keypoint's bearing: 0.75 px of 1080, for SIFT at half size", 0.01, 2.0);
    field(&P::inlier_angle_deg, "inlier_angle_deg", "deg",
          "largest angle between the bearing of an inlier and its triangulated point: three standard deviations", 0.05,
          5.0);
    field(&P::iterations, "iterations", "1", "maximum number of RANSAC samples", 10, 100000);
    field(&P::min_inliers, "min_inliers", "1",
          "smallest number of inliers; an epipolar plane is a weaker constraint than a point, so more than "
          "with points",
          6, 1000);
    field(&P::max_rotation_deg, "max_rotation_deg", "deg",
          "largest rotation beyond the heading: tilt of the road and heading error", 1.0, 180.0);
  }
};

/// Rotation and direction of translation between a landmark's panorama and the current one. The distance is not
/// observable.
struct FivePointMotion {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();    ///< landmark_from_panorama; X right, Y down, Z forward
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();       ///< of the current panorama, in the landmark's frame, unit
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  ///< of the rotation, rad^2, axes of the landmark
};

struct FivePointResult {
  std::optional<FivePointMotion> motion;
  int matches = 0;     ///< keypoints matched near the heading
  int inliers = 0;     ///< of these, inliers of one motion
  std::string reason;  ///< why there is no motion; else empty
};

/// [Lu2015 5.2]: SIFT matches near the heading, aligned by it; five-point RANSAC (Stewenius) on the bearings that
/// discards samples with a large remaining rotation; least squares over the inliers. `heading_rad`: yaw now minus yaw
/// at the landmark, left positive. Deterministic.
FivePointResult estimate_five_point_motion(std::span<const landmarks::Keypoint> panorama,
                                           std::span<const landmarks::Keypoint> landmark, double heading_rad,
                                           const FivePointParameters& parameters);

}  // namespace panvo::position_corrector
