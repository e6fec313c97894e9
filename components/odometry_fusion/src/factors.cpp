// SPDX-License-Identifier: Apache-2.0
#include "panvo/odometry_fusion/factors.hpp"

#include <algorithm>
#include <cmath>

#include "squared.hpp"

namespace panvo::odometry_fusion {
namespace {

constexpr double kTilt = 0.05;  // rad/sqrt(s), of the ground and the suspension

/// Rotation missing in the filter's step, rad, in the axes at its begin.
Eigen::Vector3d missing(const MotionFilter& filter, const Eigen::Matrix3d& measured) {
  return vision::so3_log(measured * filter.step().linear().transpose());
}

/// Translation of a constant twist, per unit of its velocity: left Jacobian of SO(3), to the second order.
Eigen::Matrix3d arc(const Eigen::Vector3d& rotation_rad) {
  const Eigen::Matrix3d w = vision::skew(rotation_rad);
  return Eigen::Matrix3d::Identity() + 0.5 * w + w * w / 6.0;
}

}  // namespace

Factor stereo_factor(const MotionFilter& filter, const Eigen::Isometry3d& measured,
                     const vision::Matrix6d& covariance) {
  const Eigen::Vector3d rotation = vision::so3_log(measured.linear());
  Factor factor(6);
  factor.residual.head<3>() =
      (1.0 + filter.learned()[kStereoScale]) * measured.translation() - filter.step().translation();
  factor.residual.tail<3>() = missing(filter, vision::so3_exp((1.0 + filter.learned()[kStereoTurnScale]) * rotation));
  factor.by_step.setIdentity();
  factor.by_learned.block<3, 1>(0, kStereoScale) = -filter.predicted_step().translation();
  factor.by_learned.block<3, 1>(3, kStereoTurnScale) = -vision::so3_log(filter.predicted_step().linear());
  factor.noise = covariance;
  return factor;
}

Eigen::Vector3d rotation_of(std::span<const GyroSample> samples) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i < samples.size(); ++i) {
    sum += 0.5 * (samples[i - 1].rate_rad_s + samples[i].rate_rad_s) *
           seconds(samples[i - 1].stamp_ns, samples[i].stamp_ns);
  }
  return sum;
}

Factor gyro_factor(const MotionFilter& filter, std::span<const GyroSample> samples, const GyroParameters& parameters) {
  const auto& learned = filter.learned();
  const Eigen::Vector3d bias = learned.segment<3>(kGyroBias);
  const Eigen::Matrix3d mounting = vision::so3_exp(learned.segment<3>(kGyroMounting));
  Eigen::Matrix3d measured = Eigen::Matrix3d::Identity();
  double variance = 0.0;  // rad^2
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double dt_s = seconds(samples[i - 1].stamp_ns, samples[i].stamp_ns);
    const Eigen::Vector3d rate = 0.5 * (samples[i - 1].rate_rad_s + samples[i].rate_rad_s) - bias;
    measured *= vision::so3_exp(mounting * rate * dt_s / (1.0 + learned[kGyroScale]));
    variance += std::max(squared(parameters.noise_rad_s_sqrt_hz) * dt_s, samples[i].variance * dt_s * dt_s);
  }
  const Eigen::Vector3d rotation = vision::so3_log(measured);
  Factor factor(3);
  factor.residual = missing(filter, measured);
  factor.by_step.rightCols<3>().setIdentity();
  factor.by_learned.middleCols<3>(kGyroBias) =
      seconds(samples.front().stamp_ns, samples.back().stamp_ns) * Eigen::Matrix3d::Identity();
  factor.by_learned.middleCols<3>(kGyroMounting) = vision::skew(rotation);
  factor.by_learned.col(kGyroScale) = rotation;
  factor.by_learned.col(kGyroClock) = samples.front().rate_rad_s - samples.back().rate_rad_s;
  factor.noise = variance * Eigen::Matrix3d::Identity();
  return factor;
}

Factor standstill_factor(const MotionFilter& filter) {
  constexpr double kSigma_m = 1e-4;
  Factor factor(3);
  factor.residual = -filter.step().translation();
  factor.by_step.leftCols<3>().setIdentity();
  factor.noise = kSigma_m * kSigma_m * Eigen::Matrix3d::Identity();
  return factor;
}

WheelMotion motion_of(std::span<const WheelSample> samples) {
  WheelMotion sum;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const auto& a = samples[i - 1];
    const auto& b = samples[i];
    const double half_s = 0.5 * seconds(a.stamp_ns, b.stamp_ns);
    sum.forward_m += half_s * (a.forward_m_s + b.forward_m_s);
    sum.left_m += half_s * (a.left_m_s + b.left_m_s);
    sum.yaw_rad += half_s * (a.yaw_rate_rad_s + b.yaw_rate_rad_s);
  }
  return sum;
}

Factor wheel_factor(const MotionFilter& filter, std::span<const WheelSample> samples, const WheelParameters& parameters,
                    bool has_yaw) {
  const auto& learned = filter.learned();
  const auto& last = samples.back();
  const WheelMotion wheels = motion_of(samples);
  const Eigen::Vector3d turned = vision::so3_log(filter.step().linear());
  const Eigen::Matrix3d along = arc(turned);
  const double scale = 1.0 + learned[kWheelScale];
  const Eigen::Vector3d rolled(
      scale * wheels.forward_m,
      scale * (wheels.left_m + learned[kWheelLeft] * wheels.forward_m) + learned[kAxle] * turned.z(),
      scale * learned[kWheelUp] * wheels.forward_m);

  Factor factor(has_yaw ? 6 : 3);
  factor.residual.head<3>() = along * rolled - filter.step().translation();
  factor.by_step.topLeftCorner<3, 3>().setIdentity();
  factor.by_step.block<3, 3>(0, 3) = 0.5 * vision::skew(rolled);  // the arc bends with the rotation
  factor.by_step(1, 5) -= learned[kAxle];
  factor.by_learned.block<3, 1>(0, kWheelScale) = -filter.predicted_step().translation() / scale;
  factor.by_learned.block<3, 1>(0, kWheelLeft) = -along * Eigen::Vector3d(0.0, wheels.forward_m, 0.0);
  factor.by_learned.block<3, 1>(0, kWheelUp) = -along * Eigen::Vector3d(0.0, 0.0, wheels.forward_m);
  factor.by_learned.block<3, 1>(0, kAxle) = -along * Eigen::Vector3d(0.0, turned.z(), 0.0);
  const double way_m = std::hypot(wheels.forward_m, wheels.left_m);
  const double side = squared(parameters.side_slip_per_sqrt_m) * way_m + squared(parameters.tick_m);
  const double dt_s = seconds(samples.front().stamp_ns, last.stamp_ns);
  factor.noise(0, 0) = std::max(squared(parameters.noise_per_sqrt_m) * way_m, last.forward_variance * dt_s * dt_s) +
                       squared(parameters.tick_m);
  factor.noise(1, 1) = factor.noise(2, 2) = side;
  if (has_yaw) {
    factor.residual[3] = (1.0 + learned[kWheelYawScale]) * wheels.yaw_rad - turned.z();
    factor.by_step(3, 5) = 1.0;
    // By the filter's rotation, since noise of the wheels' own would make the scale appear too small.
    factor.by_learned(3, kWheelYawScale) = -turned.z() / (1.0 + learned[kWheelYawScale]);
    const double sigma2 = squared(parameters.yaw_noise_rad_per_sqrt_m) * way_m +
                          squared(parameters.yaw_error_ratio * wheels.yaw_rad) + squared(parameters.tick_m);
    factor.noise(3, 3) = std::max(sigma2, last.yaw_variance * dt_s * dt_s);
    // The ground is smooth.
    for (const int tilt : {0, 1}) {
      factor.residual[4 + tilt] = -turned[tilt];
      factor.by_step(4 + tilt, 3 + tilt) = 1.0;
      factor.noise(4 + tilt, 4 + tilt) = squared(kTilt) * dt_s;
    }
  }
  return factor;
}

}  // namespace panvo::odometry_fusion
