// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "panvo/vision/pose.hpp"

namespace panvo::binocular_odometry {

/// Constant velocity: what the camera did last, it goes on doing. At rest until told otherwise.
class MotionModel {
 public:
  /// Takes over a measured motion that lasted duration_ns (> 0).
  void update(const Eigen::Isometry3d& current_from_previous, std::int64_t duration_ns) {
    velocity_ = vision::se3_log(current_from_previous) / seconds(duration_ns);
  }

  /// Motion over the next duration_ns (> 0).
  Eigen::Isometry3d predict(std::int64_t duration_ns) const {
    return vision::se3_exp(velocity_ * seconds(duration_ns));
  }

  /// Covariance of such a prediction under white accelerations (standard deviations, m/s^2 and rad/s^2).
  static vision::Matrix6d covariance(std::int64_t duration_ns, double acceleration, double angular_acceleration) {
    const double t2 = seconds(duration_ns) * seconds(duration_ns);
    vision::Vector6d sigma;
    sigma << Eigen::Vector3d::Constant(0.5 * acceleration * t2),
        Eigen::Vector3d::Constant(0.5 * angular_acceleration * t2);
    return sigma.cwiseAbs2().asDiagonal();
  }

 private:
  static double seconds(std::int64_t duration_ns) { return 1e-9 * static_cast<double>(duration_ns); }

  vision::Vector6d velocity_ = vision::Vector6d::Zero();
};

}  // namespace panvo::binocular_odometry
