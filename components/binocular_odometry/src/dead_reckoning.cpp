// SPDX-License-Identifier: Apache-2.0
#include "dead_reckoning.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace panvo::binocular_odometry {
namespace {

constexpr double kStep_s = 0.05;    // integration step; the path within is nearly straight
constexpr double kMaxSteps = 1000;  // limit for gaps of minutes, after which the pose is unknown anyway
// Standard deviation of a uniformly distributed direction; upper bound of the heading error.
constexpr double kMaxAngle_rad = std::numbers::pi / std::numbers::sqrt3;
// Standard deviations for an urban vehicle: m/s and rad/s.
constexpr double kAnySpeed = 10.0, kAnyTurn = 0.5;

}  // namespace

DeadReckoning::DeadReckoning(double acceleration, double angular_acceleration) {
  variance_rate_ << Eigen::Vector3d::Constant(acceleration * acceleration),
      Eigen::Vector3d::Constant(angular_acceleration * angular_acceleration);
}

void DeadReckoning::begin(Velocity velocity) {
  begin_from_current_.setIdentity();
  covariance_.setZero();
  if (velocity == Velocity::kMeasured) return;
  covariance_.diagonal().segment<3>(6).setConstant(kAnySpeed * kAnySpeed);
  covariance_.diagonal().tail<3>().setConstant(kAnyTurn * kAnyTurn);
}

void DeadReckoning::go_on(const vision::Vector6d& twist, std::int64_t duration_ns) {
  const double duration_s = 1e-9 * static_cast<double>(duration_ns);
  const double steps = std::clamp(std::ceil(duration_s / kStep_s), 1.0, kMaxSteps);
  const Eigen::Isometry3d step = vision::se3_exp(twist / steps);
  for (int i = 0; i < static_cast<int>(steps); ++i) advance(step, duration_s / steps);
}

void DeadReckoning::advance(const Eigen::Isometry3d& previous_from_current, double duration_s) {
  const Eigen::Matrix3d begin_from_camera = begin_from_current_.linear();
  Matrix12d transition = Matrix12d::Identity();
  transition.block<3, 3>(0, 3) = -vision::skew(begin_from_camera * previous_from_current.translation());
  transition.block<3, 3>(0, 6) = transition.block<3, 3>(3, 9) = duration_s * begin_from_camera;
  covariance_ = (transition * covariance_ * transition.transpose()).eval();
  for (int axis = 0; axis < 6; ++axis) {
    covariance_(axis, axis) += variance_rate_[axis] * std::pow(duration_s, 3) / 3.0;
    covariance_(axis + 6, axis + 6) += variance_rate_[axis] * duration_s;
  }
  for (const int part : {0, 3}) {
    const Eigen::Matrix3d meets = 0.5 * variance_rate_[part] * duration_s * duration_s * begin_from_camera;
    covariance_.block<3, 3>(part, part + 6) += meets;
    covariance_.block<3, 3>(part + 6, part) += meets.transpose();
  }
  const double angle_rad = std::sqrt(covariance_.diagonal().segment<3>(3).maxCoeff());
  if (angle_rad > kMaxAngle_rad) {
    covariance_.middleRows<3>(3) *= kMaxAngle_rad / angle_rad;
    covariance_.middleCols<3>(3) *= kMaxAngle_rad / angle_rad;
  }
  begin_from_current_ = begin_from_current_ * previous_from_current;
  begin_from_current_.linear() = vision::nearest_rotation(begin_from_current_.linear());
}

vision::Matrix6d DeadReckoning::step_covariance(std::int64_t duration_ns) const {
  const double duration_s = 1e-9 * static_cast<double>(duration_ns);
  vision::Matrix6d velocity = covariance_.bottomRightCorner<6, 6>();
  velocity.diagonal() += variance_rate_ * duration_s;
  return velocity * duration_s * duration_s;
}

}  // namespace panvo::binocular_odometry
