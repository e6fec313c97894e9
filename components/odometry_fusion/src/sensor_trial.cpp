// SPDX-License-Identifier: Apache-2.0
#include "panvo/odometry_fusion/sensor_trial.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace panvo::odometry_fusion {
namespace {

constexpr double kWindow_s = 1.0;  // averages vibration, shorter than a turn
constexpr double kForget = 0.97;   // weight of a window relative to the next one: a minute counts
constexpr int kMinWindows = 3;
constexpr double kTurned_rad2 = 0.1;  // sum of squares: one turn of 20 degrees
constexpr double kRidge_rad2 = 1e-3;
constexpr double kMoved_m2 = 1.0;      // sum of squares: four windows of half a metre
constexpr double kMinMove_m = 0.5;     // of a window
constexpr double kSpeedChanges = 1.0;  // sum of squares, m^2/s^2: one start
constexpr double kLate_s = 0.1;
constexpr double kDegrees = 180.0 / M_PI;

// A good sensor's scale is within the first, which includes the cameras' errors; beyond the second it is wrong.
constexpr double kGoodGyro = 0.05, kWrongGyro = 0.1;
constexpr double kGood = 0.15, kWrong = 0.2;
constexpr double kGoodYaw = 0.35;      // of wheels: the track width in turns is uncertain
constexpr double kScatter = 0.1;       // of the motion, between the sensors
constexpr double kGyroScatter = 0.02;  // rad/s, of windows without motion

bool is_about(double value, double expected) { return std::abs(value / expected - 1.0) < 0.15; }

/// Why a rate is wrong by a factor.
std::string cause_of_rate(double factor) {
  const std::string sign = factor < 0.0 ? " with the opposite sign" : "";
  if (is_about(std::abs(factor), kDegrees)) return "are in degrees/s" + sign + ": publish rad/s";
  if (is_about(std::abs(factor), 1.0 / kDegrees)) return "were divided by 57.3" + sign + ": publish rad/s";
  if (std::abs(factor) < kWrong) return "do not follow turns: the sensor is stuck, or it is another vehicle's";
  if (is_about(factor, -1.0)) return "have the opposite sign";
  return fmt::format("are {:.2f} times the cameras'", factor);
}

std::string cause_of_speed(double factor) {
  struct Unit {
    double factor;
    const char* name;
  };
  constexpr Unit kUnits[] = {{3.6, "km/h"}, {2.237, "miles/h"}, {100.0, "cm/s"}, {1000.0, "mm/s"}, {3.281, "feet/s"}};
  for (const auto& unit : kUnits) {
    if (is_about(std::abs(factor), unit.factor)) {
      return fmt::format("is in {}{}: publish m/s, forward positive", unit.name, factor < 0.0 ? ", reversed" : "");
    }
  }
  if (std::abs(factor) < kWrong) return "stays near 0 while the cameras see motion: check encoders and topic";
  if (is_about(factor, -1.0)) return "has the opposite sign: publish forward as positive linear.x";
  return fmt::format("is {:.2f} times the cameras': correct the wheel radius, or the stereo baseline", factor);
}

}  // namespace

void GyroTrial::add(const Eigen::Vector3d& by_gyro, const Eigen::Vector3d& seen, double dt_s) {
  window_gyro_ += by_gyro;
  window_seen_ += seen;
  window_s_ += dt_s;
  if (window_s_ < kWindow_s) return;
  add_window();
  window_gyro_.setZero();
  window_seen_.setZero();
  window_s_ = 0.0;
}

/// Weighted means and sums of products about them, after Welford.
void GyroTrial::add_window() {
  const Eigen::Vector3d gyro = window_gyro_ / window_s_;
  const Eigen::Vector3d seen = window_seen_ / window_s_;
  const double before = kForget * weight_;
  weight_ = before + 1.0;
  const Eigen::Vector3d gyro_off = gyro - mean_gyro_;
  const Eigen::Vector3d seen_off = seen - mean_seen_;
  const double share = before / weight_;
  gyro_seen_ = kForget * gyro_seen_ + share * gyro_off * seen_off.transpose();
  seen_seen_ = kForget * seen_seen_ + share * seen_off * seen_off.transpose();
  gyro_gyro_ = kForget * gyro_gyro_ + share * gyro_off.cwiseAbs2();
  mean_gyro_ += gyro_off / weight_;
  mean_seen_ += seen_off / weight_;
  ++windows_;
}

Eigen::Matrix3d GyroTrial::response() const {
  return gyro_seen_ * (seen_seen_ + kRidge_rad2 * Eigen::Matrix3d::Identity()).inverse();
}

bool GyroTrial::is_excited(int axis) const {
  return windows_ >= kMinWindows && seen_seen_(axis, axis) * kWindow_s * kWindow_s > kTurned_rad2;
}

Eigen::Vector3d GyroTrial::residual_variance() const {
  return (gyro_gyro_ - 2.0 * gyro_seen_.diagonal() + seen_seen_.diagonal()) / weight_;
}

double GyroTrial::bias_sigma() const { return std::sqrt(residual_variance().maxCoeff() / weight_) + 1e-4; }

/// Whether the gyroscope follows the cameras on all axes, but for a constant difference.
bool GyroTrial::is_quiet() const {
  const double limit = kGyroScatter * kGyroScatter + kScatter * kScatter * seen_seen_.trace() / (weight_ + 1.0);
  return windows_ >= kMinWindows && residual_variance().maxCoeff() < limit;
}

bool GyroTrial::is_plausible() const { return is_quiet() && verdict().fault.empty(); }

Verdict GyroTrial::verdict() const {
  const Eigen::Matrix3d shown = response();
  bool is_any_excited = false, are_all_good = true;
  for (int axis = 2; axis >= 0; --axis) {  // vehicles turn about z above all
    if (!is_excited(axis)) continue;
    is_any_excited = true;
    const Eigen::Vector3d column = shown.col(axis);
    const double off = (column - Eigen::Vector3d::Unit(axis)).norm();
    are_all_good &= off < kGoodGyro;
    if (off < kWrongGyro) continue;
    const char* names = "xyz";
    int strongest = 0;
    column.cwiseAbs().maxCoeff(&strongest);
    if (strongest == axis || column.norm() < kWrong) {
      const std::string cause = cause_of_rate(column[axis]);
      const bool is_reversed = is_about(column[axis], -1.0);
      return {false, fmt::format("rates about {} {}{}", names[axis], cause,
                                 is_reversed ? ": upside down? Correct base_link -> imu in /tf_static" : "")};
    }
    return {false, fmt::format("turns about {} show on axis {} ({:.2f} times): correct the IMU's axes, or base_link -> "
                               "imu in /tf_static",
                               names[axis], names[strongest], column[strongest])};
  }
  if (is_any_excited && are_all_good && is_quiet()) return {true, ""};
  if (windows_ > 3 * kMinWindows && !is_quiet()) {
    return {false, "rates do not follow the cameras: check the IMU's stamps, axes and units"};
  }
  return {};
}

void WheelTrial::Fit::add(double measured, double seen, double change) {
  const Eigen::Vector2d by(seen, -change);
  normal_ = kForget * normal_ + by * by.transpose();
  product_ = kForget * product_ + measured * by;
  measured2_ = kForget * measured2_ + measured * measured;
}

Eigen::Vector2d WheelTrial::Fit::solve() const {
  constexpr double kRidge = 1e-2;  // no change of speed: no delay
  Eigen::Matrix2d damped = normal_;
  damped(1, 1) += kRidge;
  return damped.ldlt().solve(product_);
}

double WheelTrial::Fit::scatter() const {
  return std::sqrt(std::max(0.0, measured2_ - solve().dot(product_)) / seen2());
}

void WheelTrial::add(const Rolled& rolled, double seen_forward_m, double seen_yaw_rad, double dt_s) {
  window_.forward_m += rolled.forward_m;
  window_.yaw_rad += rolled.yaw_rad;
  window_.speed_change_m_s += rolled.speed_change_m_s;
  window_seen_m_ += seen_forward_m;
  window_seen_rad_ += seen_yaw_rad;
  window_s_ += dt_s;
  const bool has_moved = std::abs(window_seen_m_) > kMinMove_m || std::abs(window_seen_rad_) > 0.1 * kMinMove_m ||
                         std::abs(window_.forward_m) > kMinMove_m;
  if (window_s_ < kWindow_s || (!has_moved && window_s_ < 10.0 * kWindow_s)) return;
  if (has_moved) {
    forward_.add(window_.forward_m, window_seen_m_, window_.speed_change_m_s);
    yaw_.add(window_.yaw_rad, window_seen_rad_, 0.0);
  }
  window_ = {};
  window_seen_m_ = window_seen_rad_ = window_s_ = 0.0;
}

double WheelTrial::late_s() const { return forward_.change2() > kSpeedChanges ? forward_.solve()[1] : 0.0; }

Verdict WheelTrial::verdict() const {
  if (forward_.seen2() < kMoved_m2) return {};
  const double scale = forward_.solve()[0];
  if (std::abs(scale - 1.0) > kWrong) return {false, "forward speed " + cause_of_speed(scale)};
  if (std::abs(late_s()) > kLate_s) {
    return {false, fmt::format("stamps are {:.2f} s {}: synchronise the clocks", std::abs(late_s()),
                               late_s() > 0.0 ? "late" : "early")};
  }
  if (std::abs(scale - 1.0) < kGood && forward_.scatter() < kScatter) return {true, ""};
  if (forward_.seen2() > 10.0 * kMoved_m2) {
    return {false, fmt::format("forward speed does not follow the cameras ({:.2f} times, scattered by {:.0f} %): slip, "
                               "wrong stamps or wheel radius",
                               scale, 100.0 * forward_.scatter())};
  }
  return {};
}

Verdict WheelTrial::yaw_verdict() const {
  if (yaw_.seen2() < kTurned_rad2 || yaw_.measured2() == 0.0) return {};
  const double scale = yaw_.solve()[0];
  if (std::abs(scale - 1.0) < kGoodYaw && yaw_.scatter() < kGoodYaw) return {true, ""};
  return {false, "yaw rates " + cause_of_rate(scale)};
}

}  // namespace panvo::odometry_fusion
