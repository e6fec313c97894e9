// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "panvo/vision/pose.hpp"

namespace panvo::binocular_odometry {

/// Predicted motion since the last measured pose, with covariance. The velocity is a random walk (Brownian motion), so
/// the position error grows with time to the power of 3/2, and of 5/2 due to the heading; many unmeasured frames are as
/// uncertain as one gap of the same duration.
class DeadReckoning {
 public:
  enum class Velocity { kMeasured, kUnknown };

  /// Standard deviations per axis of the velocity change within one second, m/s and rad/s. It grows with the square
  /// root of time.
  DeadReckoning(double acceleration, double angular_acceleration);

  /// Restarts at a measured pose; `velocity`: whether the velocity was measured as well.
  void begin(Velocity velocity);

  /// Appends a motion previous_from_current with constant twist, of duration_ns (> 0).
  void go_on(const vision::Vector6d& twist, std::int64_t duration_ns);

  const Eigen::Isometry3d& begin_from_current() const { return begin_from_current_; }

  /// Covariance of begin_from_current.
  vision::Matrix6d covariance() const { return covariance_.topLeftCorner<6, 6>(); }

  /// Covariance of the motion over the next duration_ns, in the axes of its start.
  vision::Matrix6d step_covariance(std::int64_t duration_ns) const;

 private:
  using Matrix12d = Eigen::Matrix<double, 12, 12>;

  void advance(const Eigen::Isometry3d& previous_from_current, double duration_s);

  vision::Vector6d variance_rate_;  // of the velocity, per second
  Eigen::Isometry3d begin_from_current_ = Eigen::Isometry3d::Identity();
  Matrix12d covariance_ =
      Matrix12d::Zero();  // of the pose, in the axes of the start, and of the velocity, in those of the camera
};

}  // namespace panvo::binocular_odometry
