// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "panvo/vision/pose.hpp"

namespace panvo::binocular_odometry {

/// The motion since the last pose that was measured, while nothing is measured, and how uncertain it is: the camera goes on at the velocity it
/// had, and that velocity wanders as Brownian motion does. So the position errs with the time that has passed to the power of 3/2, by the heading to the
/// power of 5/2, and a hundred frames without a measurement are as uncertain as one gap of their length.
class DeadReckoning {
 public:
  enum class Velocity { kMeasured, kUnknown };

  /// By how much the velocity changes unseen within a second, standard deviation of each axis: m/s and rad/s. It grows with the root of the time.
  DeadReckoning(double acceleration, double angular_acceleration);

  /// A pose was measured, and the velocity with it or not: begins there.
  void begin(Velocity velocity);

  /// Goes on by a motion previous_from_current of constant twist that takes duration_ns (> 0).
  void go_on(const vision::Vector6d& twist, std::int64_t duration_ns);

  const Eigen::Isometry3d& begin_from_current() const { return begin_from_current_; }

  /// Of begin_from_current.
  vision::Matrix6d covariance() const { return covariance_.topLeftCorner<6, 6>(); }

  /// Of the motion over the next duration_ns at the velocity that is known by now, in the axes of where it begins.
  vision::Matrix6d step_covariance(std::int64_t duration_ns) const;

 private:
  using Matrix12d = Eigen::Matrix<double, 12, 12>;

  void advance(const Eigen::Isometry3d& previous_from_current, double duration_s);

  vision::Vector6d variance_rate_;  // of the velocity, per second
  Eigen::Isometry3d begin_from_current_ = Eigen::Isometry3d::Identity();
  Matrix12d covariance_ =
      Matrix12d::Zero();  // of the pose, in the axes of the beginning, and of the velocity, in those of the camera
};

}  // namespace panvo::binocular_odometry
