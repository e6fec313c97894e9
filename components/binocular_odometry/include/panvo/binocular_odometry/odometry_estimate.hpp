// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>

#include "panvo/vision/pose.hpp"

namespace panvo::binocular_odometry {

/// Quality of an estimate.
struct Quality {
  int detected = 0;                   ///< features found in the frame
  int tracked = 0;                    ///< of these, tracked from earlier frames
  int matched = 0;                    ///< of the detected ones, also found in the right image
  int inliers = 0;                    ///< candidates consistent with the camera motion
  double inlier_ratio = 0.0;          ///< inliers per candidate
  double residual_px = 0.0;           ///< RMS reprojection error of the inliers
  double lean_sigma_rad_per_m = 0.0;  ///< of a constant turn per metre, which the covariances do not contain
  bool reliable = false;  ///< true: measured; false: predicted with the last motion, or the last pose for a late frame
  std::string reason;     ///< why not reliable, with figures ("9 inliers of 20 needed"); empty if reliable
};

/// Estimate for one frame. Coordinate frames are left rectified optical frames; odom is that of the first image.
/// Covariances as defined by vision::pose_error: translation (m), then rotation (rad), in the axes of the parent frame.
struct OdometryEstimate {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d odom_from_left = Eigen::Isometry3d::Identity();
  vision::Matrix6d odom_from_left_covariance = vision::Matrix6d::Zero();    ///< grows along the path
  Eigen::Isometry3d previous_from_current = Eigen::Isometry3d::Identity();  ///< motion since the previous estimate
  vision::Matrix6d previous_from_current_covariance = vision::Matrix6d::Zero();
  Quality quality;
};

}  // namespace panvo::binocular_odometry
