// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "panvo/vision/pose.hpp"

namespace panvo::vision {

/// Covariance of the motion a_from_b between two poses of an odometry, in the axes of a: what the pose of b has gained
/// over that of a. Variances below `min_variance`, also negative ones of a reset covariance, are raised to it; the
/// default is for rounding errors.
Matrix6d step_covariance(const Eigen::Isometry3d& odom_from_a, const Matrix6d& covariance_a,
                         const Eigen::Isometry3d& odom_from_b, const Matrix6d& covariance_b,
                         double min_variance = 1e-12);

/// Covariance of a pose after a time of unknown motion: in any direction, as far as its twist (m/s and rad/s) leads.
Matrix6d after_unknown_motion(const Matrix6d& covariance, const Vector6d& twist, double time_s);

}  // namespace panvo::vision
