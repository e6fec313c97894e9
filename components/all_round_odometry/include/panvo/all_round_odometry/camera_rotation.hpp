// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "panvo/all_round_odometry/panorama_points.hpp"

namespace panvo::all_round_odometry {

/// Error of the panoramic camera's rotation on the vehicle as stated by the extrinsics, from points and known motion:
/// the bearings of a point before and after lie in one plane with the motion. Motion straight ahead shows yaw and pitch,
/// bends show roll, too. Kalman filter.
class CameraRotation {
 public:
  /// From the axes in which the bearings are given to those of the vehicle.
  const Eigen::Matrix3d& base_from_stated() const noexcept { return base_from_stated_; }
  /// Of a small rotation on the left of it, rad^2.
  Eigen::Matrix3d covariance() const;

  /// `then_from_now`: motion of the camera since the reference, in the axes of the vehicle.
  void add(const PointTracks& tracks, const Eigen::Isometry3d& then_from_now);

 private:
  static constexpr double kPrior_rad = 0.05;  // standard deviation of measured extrinsics

  Eigen::Matrix3d base_from_stated_ = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d covariance_ = kPrior_rad * kPrior_rad * Eigen::Matrix3d::Identity();
  int contradicted_ = 0;  // panoramas in a row
};

}  // namespace panvo::all_round_odometry
