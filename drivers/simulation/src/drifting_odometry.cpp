// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/drifting_odometry.hpp"

#include <cmath>

namespace panvo::simulation {

DriftingOdometry::DriftingOdometry(const DriftParameters& parameters, std::uint64_t seed)
    : parameters_(parameters), random_(seed, "drifting odometry") {}

DriftingOdometry::Pose DriftingOdometry::step(const Eigen::Isometry3d& true_world_from_base) {
  if (!last_truth_) {
    last_truth_ = true_world_from_base;
    return pose_;
  }
  Eigen::Isometry3d move = last_truth_->inverse() * true_world_from_base;
  last_truth_ = true_world_from_base;
  const double moved_m = move.translation().norm();
  const double step_m = std::sqrt(moved_m * parameters_.persistence_m);  // variances of independent steps add up
  vision::Vector6d sigma;
  sigma << Eigen::Vector3d::Constant(parameters_.motion_error_ratio * step_m + 1e-4),
      Eigen::Vector3d::Constant(parameters_.rotation_error_rad_per_m * step_m + 1e-5);
  const vision::Vector6d error = sigma.cwiseProduct(noise());
  move.translation() = (1.0 + parameters_.scale_error) * move.translation() + error.head<3>();
  const Eigen::Vector3d turned(0.0, 0.0, parameters_.yaw_error_rad_per_m * moved_m);
  move.linear() = vision::so3_exp(error.tail<3>() + turned) * move.linear();
  pose_.covariance = vision::compose_covariance(pose_.odom_from_base, pose_.covariance, move,
                                                vision::Matrix6d(sigma.cwiseAbs2().asDiagonal()));
  pose_.odom_from_base = pose_.odom_from_base * move;
  pose_.odom_from_base.linear() = vision::nearest_rotation(pose_.odom_from_base.linear());
  return pose_;
}

vision::Vector6d DriftingOdometry::noise() {
  vision::Vector6d noise;
  for (double& one : noise) one = random_.gaussian();
  return noise;
}

}  // namespace panvo::simulation
