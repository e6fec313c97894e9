// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>

#include "panvo/vision/pose.hpp"

/// What the sensors measure, with stamps in ns. The stereo camera's clock is the reference.
namespace panvo::odometry_fusion {

/// One result of the stereo odometry.
struct StereoPose {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d odom_from_base = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Zero();  ///< of the pose, as vision::pose_error
  bool is_reliable = true;                                 ///< false: no usable image
};

/// One measurement of a gyroscope.
struct GyroSample {
  std::int64_t stamp_ns = 0;
  Eigen::Vector3d rate_rad_s = Eigen::Vector3d::Zero();  ///< axes of base_link
  double variance = 0.0;                                 ///< as the message says, (rad/s)^2; 0: unknown
};

/// One measurement of wheel encoders, as the velocity of base_link.
struct WheelSample {
  std::int64_t stamp_ns = 0;
  double forward_m_s = 0.0, left_m_s = 0.0, yaw_rate_rad_s = 0.0;
  double forward_variance = 0.0, yaw_variance = 0.0;  ///< as the message says, (m/s)^2, (rad/s)^2; 0: unknown
};

inline constexpr double kNanosecond_s = 1e-9;

inline double seconds(std::int64_t from_ns, std::int64_t to_ns) {
  return static_cast<double>(to_ns - from_ns) * kNanosecond_s;
}

inline std::int64_t later(std::int64_t stamp_ns, double by_s) { return stamp_ns + std::llround(by_s / kNanosecond_s); }

/// Linear interpolation between two samples; `share` in [0, 1].
inline GyroSample between(const GyroSample& a, const GyroSample& b, double share) {
  return {a.stamp_ns + static_cast<std::int64_t>(share * static_cast<double>(b.stamp_ns - a.stamp_ns)),
          a.rate_rad_s + share * (b.rate_rad_s - a.rate_rad_s), b.variance};
}
inline WheelSample between(const WheelSample& a, const WheelSample& b, double share) {
  const auto mix = [share](double from, double to) { return from + share * (to - from); };
  return {a.stamp_ns + static_cast<std::int64_t>(share * static_cast<double>(b.stamp_ns - a.stamp_ns)),
          mix(a.forward_m_s, b.forward_m_s),
          mix(a.left_m_s, b.left_m_s),
          mix(a.yaw_rate_rad_s, b.yaw_rate_rad_s),
          b.forward_variance,
          b.yaw_variance};
}

}  // namespace panvo::odometry_fusion
