// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "panvo/vision/pose.hpp"

namespace panvo::binocular_odometry {

/// A motion and its covariance as defined by vision::pose_error.
struct UncertainPose {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Zero();
};

/// Converts a motion of the left camera to that of the vehicle it is mounted on. `base_from_left`: pose of the rectified
/// left camera on the vehicle, exact.
UncertainPose motion_of_base(const Eigen::Isometry3d& base_from_left, const Eigen::Isometry3d& motion_of_left,
                             const vision::Matrix6d& covariance);

}  // namespace panvo::binocular_odometry
