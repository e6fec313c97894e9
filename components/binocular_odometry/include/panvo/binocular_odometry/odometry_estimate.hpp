// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>

#include "panvo/vision/pose.hpp"

namespace panvo::binocular_odometry {

/// How far an estimate can be trusted, and why not.
struct Quality {
  int detected = 0;           ///< features found in the frame
  int tracked = 0;            ///< of these, known from before
  int matched = 0;            ///< of all, found in the right image too
  int inliers = 0;            ///< tracked and matched, and moving as the camera's motion has it
  double inlier_ratio = 0.0;  ///< inliers per candidate
  double residual_px = 0.0;   ///< root mean square of the inliers' reprojection errors
  bool reliable = false;      ///< the pose was measured; else it was carried on by the last motion
  std::string reason;         ///< why not reliable, in numbers ("9 inliers of 20 needed"); empty when reliable
};

/// The odometry's answer to one frame. Frames are left rectified optical frames; odom is that of the first frame.
/// Covariances are of vision::pose_error: translation (m), then rotation (rad), in the axes of the parent frame.
struct OdometryEstimate {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d odom_from_left = Eigen::Isometry3d::Identity();
  vision::Matrix6d odom_from_left_covariance = vision::Matrix6d::Zero();  ///< grows along the path
  Eigen::Isometry3d previous_from_current =
      Eigen::Isometry3d::Identity();  ///< motion since the estimate before this one
  vision::Matrix6d previous_from_current_covariance = vision::Matrix6d::Zero();
  Quality quality;
};

}  // namespace panvo::binocular_odometry
