// SPDX-License-Identifier: Apache-2.0
#include "panvo/odometry_fusion/motion_filter.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "squared.hpp"

namespace panvo::odometry_fusion {
namespace {

// A motion that is not known at all, m/s and rad/s; far above any sensor's noise, and small enough for the arithmetic.
constexpr double kUnknownSpeed = 100.0, kUnknownRate = 30.0;
// The calibration of wheels and clocks changes slowly: temperature, load, synchronisation.
constexpr double kScaleWalk = 2e-5;    // 1/sqrt(s)
constexpr double kClockWalk_s = 1e-5;  // s/sqrt(s)

}  // namespace

LearnedVector prior_sigma(const FusionParameters& parameters) {
  LearnedVector sigma;
  const auto& gyro = parameters.gyro;
  const auto& wheels = parameters.wheels;
  sigma.segment<3>(kGyroBias).setConstant(gyro.bias_sigma_rad_s);
  sigma.segment<3>(kGyroMounting).setConstant(gyro.mounting_sigma_rad);
  sigma[kGyroScale] = gyro.scale_sigma;
  sigma[kGyroClock] = gyro.clock_sigma_s;
  sigma[kWheelScale] = wheels.scale_sigma;
  sigma[kWheelYawScale] = wheels.yaw_scale_sigma;
  sigma[kAxle] = wheels.axle_sigma_m;
  sigma[kWheelLeft] = sigma[kWheelUp] = wheels.direction_sigma_rad;
  sigma[kStereoScale] = parameters.stereo_scale_sigma;
  sigma[kStereoTurnScale] = parameters.stereo_turn_scale_sigma;
  return sigma;
}

MotionFilter::MotionFilter(const FusionParameters& parameters) : parameters_(parameters) {
  covariance_.diagonal().tail<kLearned>() = prior_sigma(parameters).cwiseAbs2();
}

void MotionFilter::begin_at(const Eigen::Isometry3d& odom_from_base, const vision::Matrix6d& covariance) {
  odom_from_base_ = odom_from_base;
  covariance_.topLeftCorner<6, 6>() = covariance;
}

double MotionFilter::sigma(int learned) const {
  return std::sqrt(std::max(0.0, covariance_(kLearnedAt + learned, kLearnedAt + learned)));
}

void MotionFilter::forget_step() {
  covariance_.middleRows<6>(kStep).setZero();
  covariance_.middleCols<6>(kStep).setZero();
}

/// The learned quantities change in `dt_s`.
void MotionFilter::walk(double dt_s) {
  LearnedVector density = LearnedVector::Zero();
  density.segment<3>(kGyroBias).setConstant(parameters_.gyro.bias_walk_rad_s2_sqrt_hz);
  density[kGyroClock] = kClockWalk_s;
  density[kWheelScale] = density[kWheelYawScale] = kScaleWalk;
  covariance_.diagonal().tail<kLearned>() += dt_s * density.cwiseAbs2();
}

void MotionFilter::begin_continued(double dt_s) {
  const double share = dt_s_ > 0.0 ? dt_s / dt_s_ : 1.0;
  step_.translation() *= share;
  step_.linear() = vision::so3_exp(share * vision::so3_log(step_.linear()));
  predicted_ = step_;
  covariance_.middleRows<6>(kStep) *= share;
  covariance_.middleCols<6>(kStep) *= share;
  covariance_.diagonal().segment<3>(kStep).array() += squared(parameters_.acceleration_m_s2_sqrt_hz * dt_s) * dt_s;
  covariance_.diagonal().segment<3>(kStep + 3).array() +=
      squared(parameters_.turn_acceleration_rad_s2_sqrt_hz * dt_s) * dt_s;
  dt_s_ = dt_s;
  is_still_ = false;
  walk(dt_s);
}

void MotionFilter::begin_unknown(double dt_s) {
  begin_continued(dt_s);  // a good point to linearise at
  forget_step();
  covariance_.diagonal().segment<3>(kStep).setConstant(squared(kUnknownSpeed * dt_s));
  covariance_.diagonal().segment<3>(kStep + 3).setConstant(squared(kUnknownRate * dt_s));
}

void MotionFilter::begin_still(double dt_s) {
  step_.setIdentity();
  predicted_ = step_;
  forget_step();
  dt_s_ = dt_s;
  is_still_ = true;
  walk(dt_s);
}

MotionFilter::ByAll MotionFilter::jacobian(const Factor& factor) {
  ByAll by_all = ByAll::Zero(factor.residual.size(), kSize);
  by_all.middleCols<6>(kStep) = factor.by_step;
  by_all.rightCols<kLearned>() = factor.by_learned;
  return by_all;
}

Innovation MotionFilter::innovation(const Factor& factor) const {
  const ByAll h = jacobian(factor);
  const Factor::Covariance all = h * covariance_ * h.transpose() + factor.noise;
  const Factor::Covariance by_learned =
      factor.by_learned * covariance_.bottomRightCorner<kLearned, kLearned>() * factor.by_learned.transpose();
  Innovation innovation;
  innovation.residual = factor.residual;
  innovation.systematic_variance = by_learned.diagonal().cwiseMax(0.0);
  innovation.noise_variance = (all - by_learned).diagonal().cwiseMax(0.0);
  innovation.chi_square = factor.residual.dot(all.ldlt().solve(factor.residual));
  return innovation;
}

void MotionFilter::update(const Factor& factor) { update(factor, !is_still_); }
void MotionFilter::learn(const Factor& factor) { update(factor, false); }

void MotionFilter::update(const Factor& factor, bool corrects_motion) {
  const ByAll h = jacobian(factor);
  const Factor::Covariance innovation = h * covariance_ * h.transpose() + factor.noise;
  const Eigen::Matrix<double, kSize, Eigen::Dynamic, 0, kSize, Factor::kMaxRows> cross = covariance_ * h.transpose();
  Eigen::Matrix<double, kSize, Eigen::Dynamic, 0, kSize, Factor::kMaxRows> gain =
      innovation.ldlt().solve(cross.transpose()).transpose();
  if (!corrects_motion) gain.topRows<kLearnedAt>().setZero();  // Joseph's form below holds for any gain
  const Eigen::Matrix<double, kSize, 1> correction = gain * factor.residual;
  const Matrix kept = Matrix::Identity() - gain * h;
  covariance_ = kept * covariance_ * kept.transpose() + gain * factor.noise * gain.transpose();
  covariance_ = 0.5 * (covariance_ + covariance_.transpose()).eval();
  odom_from_base_.translation() += correction.head<3>();
  odom_from_base_.linear() = vision::so3_exp(correction.segment<3>(3)) * odom_from_base_.linear();
  step_.translation() += correction.segment<3>(kStep);
  step_.linear() = vision::so3_exp(correction.segment<3>(kStep + 3)) * step_.linear();
  learned_ += correction.tail<kLearned>();
}

void MotionFilter::compose() {
  const Eigen::Matrix3d rotation = odom_from_base_.linear();
  Matrix by = Matrix::Identity();
  by.block<3, 3>(0, 3) = -vision::skew(rotation * step_.translation());
  by.block<3, 3>(0, kStep) = rotation;
  by.block<3, 3>(3, kStep + 3) = rotation;
  covariance_ = by * covariance_ * by.transpose();
  odom_from_base_ = odom_from_base_ * step_;
  odom_from_base_.linear() = Eigen::Quaterniond(odom_from_base_.linear()).normalized().toRotationMatrix();
}

void MotionFilter::restart(int first, int count, const Eigen::Ref<const Eigen::VectorXd>& value,
                           const Eigen::Ref<const Eigen::VectorXd>& sigma) {
  const int at = kLearnedAt + first;
  covariance_.middleRows(at, count).setZero();
  covariance_.middleCols(at, count).setZero();
  covariance_.diagonal().segment(at, count) = sigma.cwiseAbs2();
  learned_.segment(first, count) = value;
}

}  // namespace panvo::odometry_fusion
