// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/drifting_odometry.hpp"

#include <cmath>

namespace panvo::simulation {

DriftingOdometry::DriftingOdometry(const DriftParameters& parameters, std::uint64_t seed)
    : parameters_(parameters), random_(seed, "drifting odometry"), persisting_(noise()) {}

DriftingOdometry::Pose DriftingOdometry::step(const Eigen::Isometry3d& true_world_from_base) {
  if (!last_truth_) {
    last_truth_ = true_world_from_base;
    return pose_;
  }
  Eigen::Isometry3d move = last_truth_->inverse() * true_world_from_base;
  last_truth_ = true_world_from_base;
  const double moved_m = move.translation().norm();
  since_change_m_ += moved_m;
  if (since_change_m_ >= parameters_.persistence_m) {
    since_change_m_ = 0.0;
    persisting_ = noise();
  }
  vision::Vector6d per_metre;
  per_metre << Eigen::Vector3d::Constant(parameters_.motion_error_ratio),
      Eigen::Vector3d::Constant(parameters_.rotation_error_rad_per_m);
  vision::Vector6d measured;  // independent error of each step, in addition to the persisting one
  measured << Eigen::Vector3d::Constant(1e-4), Eigen::Vector3d::Constant(1e-5);
  const vision::Vector6d error = moved_m * per_metre.cwiseProduct(persisting_) + measured.cwiseProduct(noise());
  move.translation() = (1.0 + parameters_.scale_error) * move.translation() + error.head<3>();
  const Eigen::Vector3d turned(0.0, 0.0, parameters_.yaw_error_rad_per_m * moved_m);
  move.linear() = vision::so3_exp(error.tail<3>() + turned) * move.linear();
  // Variances of independent sections add up: the variance grows with the distance, not with its square.
  const vision::Vector6d variance = moved_m * parameters_.persistence_m * per_metre.cwiseAbs2() + measured.cwiseAbs2();
  pose_.covariance =
      vision::compose_covariance(pose_.odom_from_base, pose_.covariance, move, vision::Matrix6d(variance.asDiagonal()));
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
