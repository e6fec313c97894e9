// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "panvo/vision/pose.hpp"
#include "panvo/vision/reach.hpp"

namespace panvo::vision {

/// Whether a later pose of an odometry is on the path of an earlier one. An odometry that was restarted says a place
/// that no vehicle reaches in `time_s`, or knows the place far better.
inline bool is_same_path(const Eigen::Isometry3d& earlier, const Matrix6d& earlier_covariance,
                         const Eigen::Isometry3d& later, const Matrix6d& later_covariance, double time_s,
                         double max_speed_m_s) {
  constexpr double kForgotten = 0.5;  // of the variance: measuring the last metres again improves them less
  const double before_m2 = earlier_covariance.topLeftCorner<3, 3>().trace();
  const double now_m2 = later_covariance.topLeftCorner<3, 3>().trace();
  return now_m2 >= kForgotten * before_m2 && is_within_reach(earlier, later, time_s, max_speed_m_s);
}

}  // namespace panvo::vision
