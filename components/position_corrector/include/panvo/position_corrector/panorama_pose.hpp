// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <string>

#include "panvo/landmarks/panoramic_landmark.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::position_corrector {

struct PanoramaPoseParameters {
  double azimuth_window_deg = 25.0;
  double descriptor_ratio = 0.85;
  double bearing_sigma_deg = 0.25;
  double inlier_angle_deg = 0.8;
  int iterations = 200;
  int fewest_inliers = 12;
  int fewest_weak_inliers = 7;
  double fewest_inliers_share = 0.25;
  int fewest_sectors = 4;
  double largest_turn_deg = 25.0;
  double largest_tilt_deg = 20.0;
  double largest_offset_m = 25.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = PanoramaPoseParameters;
    field(&P::azimuth_window_deg, "azimuth_window_deg", "deg",
          "how far a keypoint's azimuth may lie from where the heading puts it: heading's error and parallax", 2.0,
          180.0);
    field(&P::descriptor_ratio, "descriptor_ratio", "1",
          "a match's descriptor distance, of that of the second best, at most", 0.3, 1.0);
    field(&P::bearing_sigma_deg, "bearing_sigma_deg", "deg",
          "standard deviation of a keypoint's bearing: 0.75 px of 1080, as SIFT at half size has it", 0.01, 2.0);
    field(&P::inlier_angle_deg, "inlier_angle_deg", "deg",
          "angle between a bearing and the point it is matched with, up to which they agree: three standard deviations",
          0.05, 5.0);
    field(&P::iterations, "iterations", "1", "samples of three that RANSAC draws, at most", 10, 10000);
    field(&P::fewest_inliers, "fewest_inliers", "1",
          "points that agree on the pose, at least; other places of the same building style reach 10", 4, 1000);
    field(&P::fewest_weak_inliers, "fewest_weak_inliers", "1",
          "and for a pose that does not stand alone: the next panorama must agree, and the vehicle be expected there",
          4, 1000);
    field(&P::fewest_inliers_share, "fewest_inliers_share", "1", "the same, of all matched points", 0.0, 1.0);
    field(&P::fewest_sectors, "fewest_sectors", "1",
          "of twelve sectors of the full turn, how many must hold inliers: one building may stand elsewhere, too", 1,
          12);
    field(&P::largest_turn_deg, "largest_turn_deg", "deg",
          "how far the pose's heading may lie from that of the compressive features", 1.0, 180.0);
    field(&P::largest_tilt_deg, "largest_tilt_deg", "deg", "how far the vehicle may be tilted against then", 1.0, 90.0);
    field(&P::largest_offset_m, "largest_offset_m", "m", "how far from the landmark a pose is believed", 1.0, 200.0);
  }
};

/// Where a panorama was taken, seen from a landmark's panorama.
struct PanoramaPose {
  Eigen::Isometry3d landmark_from_panorama = Eigen::Isometry3d::Identity();  ///< panorama frames, then and now; m
  vision::Matrix6d covariance = vision::Matrix6d::Zero();                    ///< as of vision::pose_error
  double heading_rad = 0.0;  ///< yaw now minus then, left positive, (-pi, pi]
};

struct PanoramaPoseResult {
  std::optional<PanoramaPose> pose;
  std::optional<PanoramaPose> weak_pose;  ///< one that too few points agree on; instead of `pose`
  int matches = 0;                        ///< keypoints matched with points of the landmark
  int inliers = 0;                        ///< of these, those that agree on one pose
  std::string reason;                     ///< why there is no pose; empty when there is one
};

/// The six degrees of freedom in metres, from the landmark's points and the bearings they are seen at now: matches near
/// the heading that the compressive features found, three-point RANSAC on the sphere, then refinement of the pose over all
/// that agree, each point weighed by its own uncertainty. What the paper's five-point motion [Lu2015 5.2] cannot tell, how far, the
/// points do. The same input gives the same result, bit for bit.
PanoramaPoseResult estimate_panorama_pose(std::span<const landmarks::Keypoint> panorama,
                                          std::span<const landmarks::Keypoint> landmark, double heading_rad,
                                          const PanoramaPoseParameters& parameters);

/// Yaw of a panorama against another, rad, left positive, (-pi, pi]; frames X right, Y down, Z forward.
double heading_of(const Eigen::Matrix3d& landmark_from_panorama);

}  // namespace panvo::position_corrector
