// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Cholesky>
#include <cmath>
#include <cstdint>
#include <random>

#include "panvo/localizer/localizer.hpp"

namespace panvo::localizer {

/// Squared error of a horizontal position over its expectation.
inline double position_nees(const Eigen::Isometry3d& estimate, const Eigen::Isometry3d& truth,
                            const vision::Matrix6d& covariance) {
  const Eigen::Vector2d error = vision::pose_error(estimate, truth).head<2>();
  return error.dot(covariance.topLeftCorner<2, 2>().ldlt().solve(error)) / 2.0;
}

/// A drive with bends of both directions and odometry whose lengths are wrong, and a receiver in a frame of its own.
/// Errors of fixes: half of the variance is white, half changes within `persist_s`.
class GnssDrive {
 public:
  static constexpr double kStep_m = 1.0;
  static constexpr std::int64_t kPeriod_ns = 200'000'000;
  static constexpr double kOdometry_m = 0.005, kOdometry_rad = 0.0006;  // per step

  GnssDrive(unsigned seed, double scale, double sigma_m, double persist_s = 60.0)
      : random_(seed), scale_(scale), sigma_m_(sigma_m), persist_s_(persist_s) {
    enu_from_map_.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, 2.1));
    enu_from_map_.translation() << 120.0, -40.0, 8.0;
    slow_error_m_ = std::sqrt(0.5) * sigma_m_ * noise();
  }

  OdometryPose step() {
    ++steps_;
    Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
    move.translation().x() = kStep_m;
    move.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, 0.02 * std::sin(steps_ / 40.0)));
    truth = truth * move;
    Eigen::Isometry3d measured = move;
    measured.translation() = scale_ * move.translation() + kOdometry_m * noise();
    measured.linear() = vision::so3_exp(kOdometry_rad * Eigen::Vector3d(0.0, 0.0, noise().z())) * move.linear();
    vision::Matrix6d gained = vision::Matrix6d::Zero();
    gained.topLeftCorner<3, 3>() = kOdometry_m * kOdometry_m * Eigen::Matrix3d::Identity();
    gained.bottomRightCorner<3, 3>() = Eigen::Vector3d(1e-12, 1e-12, kOdometry_rad * kOdometry_rad).asDiagonal();
    covariance_ = vision::compose_covariance(odom_, covariance_, measured, gained);
    odom_ = odom_ * measured;
    const double keep = std::exp(-1e-9 * static_cast<double>(kPeriod_ns) / persist_s_);
    slow_error_m_ = keep * slow_error_m_ + std::sqrt(0.5 * (1.0 - keep * keep)) * sigma_m_ * noise();
    return now();
  }

  OdometryPose now() const { return {stamp_ns(), odom_, covariance_, true, kLean}; }
  std::int64_t stamp_ns() const { return static_cast<std::int64_t>(steps_) * kPeriod_ns; }

  GnssFix fix() {
    const Eigen::Vector3d antenna(-0.5, 0.2, 1.5);
    const Eigen::Vector3d error = slow_error_m_ + std::sqrt(0.5) * sigma_m_ * noise();
    return {stamp_ns(), enu_from_map_ * (truth * antenna) + error, sigma_m_ * sigma_m_ * Eigen::Matrix3d::Identity(),
            antenna};
  }

  Eigen::Isometry3d true_enu_from_base() const { return enu_from_map_ * truth; }

  Eigen::Isometry3d truth = Eigen::Isometry3d::Identity();

 private:
  static constexpr double kLean = 1e-5;  // rad/m: hardly any

  Eigen::Vector3d noise() { return {normal_(random_), normal_(random_), normal_(random_)}; }

  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  const double scale_, sigma_m_, persist_s_;
  int steps_ = 0;
  Eigen::Isometry3d enu_from_map_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d odom_ = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance_ = vision::Matrix6d::Zero();
  Eigen::Vector3d slow_error_m_;
};

}  // namespace panvo::localizer
