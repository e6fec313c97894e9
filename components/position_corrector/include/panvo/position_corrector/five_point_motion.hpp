// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>

#include "panvo/landmarks/panoramic_landmark.hpp"

namespace panvo::position_corrector {

/// The paper's correction at the nearest point of a pass [Lu2015 5.2]; what it leaves open has a value with a reason here.
struct FivePointParameters {
  double azimuth_window_deg = 25.0;
  double descriptor_ratio = 0.8;
  double bearing_sigma_deg = 0.25;
  double inlier_angle_deg = 0.8;
  int iterations = 1000;
  int fewest_inliers = 20;
  double largest_rotation_deg = 15.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = FivePointParameters;
    field(&P::azimuth_window_deg, "azimuth_window_deg", "deg",
          "how far a keypoint's azimuth may lie from where the heading puts it: heading's error and parallax", 2.0,
          180.0);
    field(&P::descriptor_ratio, "descriptor_ratio", "1",
          "a match's descriptor distance, of that of the second best, at most", 0.3, 1.0);
    field(&P::bearing_sigma_deg, "bearing_sigma_deg", "deg",
          "standard deviation of a keypoint's bearing: 0.75 px of 1080, as SIFT at half size has it", 0.01, 2.0);
    field(
        &P::inlier_angle_deg, "inlier_angle_deg", "deg",
        "angle between a bearing and that of the triangulated point up to which they agree: three standard deviations",
        0.05, 5.0);
    field(&P::iterations, "iterations", "1", "samples that RANSAC draws, at most", 10, 100000);
    field(
        &P::fewest_inliers, "fewest_inliers", "1",
        "matches that agree on the motion, at least: an epipolar plane is easier to lie on than a point, so more than "
        "with points",
        6, 1000);
    field(&P::largest_rotation_deg, "largest_rotation_deg", "deg",
          "how far the rotation may lie from that of the heading alone: tilt of the road, and the heading's error", 1.0,
          180.0);
  }
};

/// Rotation, and the direction of the way, between a landmark's panorama and one of now. How far, two panoramas do not tell.
struct FivePointMotion {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();    ///< landmark_from_panorama; X right, Y down, Z forward
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();       ///< of the panorama now, in the landmark's frame, unit
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  ///< of the rotation, rad^2, axes of the landmark
};

struct FivePointResult {
  std::optional<FivePointMotion> motion;
  int matches = 0;     ///< keypoints matched near the heading
  int inliers = 0;     ///< of these, those that agree on one motion
  std::string reason;  ///< why there is no motion; empty when there is one
};

/// [Lu2015 5.2]: SIFT matches near the heading, turned by it; five-point RANSAC (Stewenius) on the bearings in which no sample
/// counts whose rotation is not small then; least squares over all that agree. `heading_rad`: yaw now minus then, left
/// positive. The same input gives the same result, bit for bit.
FivePointResult estimate_five_point_motion(std::span<const landmarks::Keypoint> panorama,
                                           std::span<const landmarks::Keypoint> landmark, double heading_rad,
                                           const FivePointParameters& parameters);

}  // namespace panvo::position_corrector
