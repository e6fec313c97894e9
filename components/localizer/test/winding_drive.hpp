// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "panvo/localizer/localizer.hpp"

namespace panvo::localizer {

/// A vehicle at 2 m/s that turns left and right alternately, and panoramas of every fifth frame.
struct Winding {
  static constexpr double kSpeed = 2.0;   // m/s
  static constexpr double kLate_s = 0.6;  // arrival of panoramas

  static double yaw(double t) { return 0.3 * std::sin(1.3 * t); }
  static double time_s(int frame) { return 100.0 + 0.04 * frame; }
  static Eigen::Isometry3d at(double t) {
    Eigen::Isometry3d pose(Eigen::Translation3d(kSpeed * (t - 100.0), 0.0, 0.0));
    pose.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, yaw(t)));
    return pose;
  }
  static std::int64_t ns(double t) { return static_cast<std::int64_t>(std::llround(t * 1e9)); }

  /// Drives from frame to frame; `extra_rad`: a turn of the odometry that is none.
  void drive(int from, int to, double ahead_s, const std::function<double(double)>& extra_rad = {}) {
    for (int i = from; i < to; ++i) {
      const double t = time_s(i);
      const OdometryPose before = std::exchange(odometry, {});
      odometry.stamp_ns = ns(t - clock_back_s);
      odometry.odom_from_base.translation().x() = kSpeed * (t - 100.0);
      odometry.odom_from_base.linear() =
          vision::so3_exp(Eigen::Vector3d(0.0, 0.0, yaw(t) + (extra_rad ? extra_rad(t) : 0.0)));
      odometry.covariance = vision::compose_covariance(before.odom_from_base, before.covariance,
                                                       before.odom_from_base.inverse() * odometry.odom_from_base,
                                                       step_variance * vision::Matrix6d::Identity());
      localizer.add(odometry);
      if (i % 5 != 0 || i < first) continue;
      const double taken = t - kLate_s, since = 0.2 * (1 + (i / 5) % panoramas_per_reference);
      uses.push_back(localizer.add(AzimuthMeasurement{ns(taken - since + ahead_s), ns(taken + ahead_s),
                                                      yaw(taken) - yaw(taken - since) + azimuth_error_rad, 1e-6}));
    }
  }

  double step_variance = 4e-8;      // of the odometry
  double clock_back_s = 0.0;        // the same: its clock was set back
  int panoramas_per_reference = 1;  // consecutive
  double azimuth_error_rad = 0.0;
  int first = 40;  // frame with a panorama

  Localizer localizer{Parameters{}};
  OdometryPose odometry{};  // last
  std::vector<AzimuthUse> uses{};
};

}  // namespace panvo::localizer
