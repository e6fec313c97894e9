// SPDX-License-Identifier: Apache-2.0
#include "panvo/odometry_fusion/standstill.hpp"

#include <algorithm>
#include <cmath>

namespace panvo::odometry_fusion {
namespace {

constexpr double kWheelSpeed = 0.01, kWheelRate = 0.01;  // m/s, rad/s: noise of motor controllers at rest
// rad/s. Standard deviation of the rates: noise of a MEMS gyroscope. A rolling vehicle shakes several times as much.
constexpr double kShaking = 0.01;
constexpr double kTurning = 0.001;  // a suspension that settles turns several times as fast

}  // namespace

bool is_still(std::span<const WheelSample> samples) {
  return !samples.empty() && std::ranges::all_of(samples, [](const WheelSample& one) {
    return std::abs(one.forward_m_s) < kWheelSpeed && std::abs(one.left_m_s) < kWheelSpeed &&
           std::abs(one.yaw_rate_rad_s) < kWheelRate;
  });
}

bool is_still(std::span<const GyroSample> samples, const Eigen::Vector3d& bias_rad_s, double bias_sigma_rad_s) {
  if (samples.empty()) return false;
  const auto count = static_cast<double>(samples.size());
  Eigen::Vector3d mean = Eigen::Vector3d::Zero(), variance = Eigen::Vector3d::Zero();
  for (const auto& one : samples) mean += one.rate_rad_s / count;
  for (const auto& one : samples) variance += (one.rate_rad_s - mean).cwiseAbs2() / count;
  return variance.maxCoeff() < kShaking * kShaking &&
         (mean - bias_rad_s).cwiseAbs().maxCoeff() < kTurning + 4.0 * bias_sigma_rad_s;
}

}  // namespace panvo::odometry_fusion
