// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

namespace panvo::vision {

/// Whether a vehicle gets from one pose to another within a time. Jitter of the stamps is allowed for: tens of
/// milliseconds at 50 m/s.
inline bool is_within_reach(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to, double time_s,
                            double max_speed_m_s) {
  constexpr double kSlack_m = 5.0;
  return (to.translation() - from.translation()).norm() <= kSlack_m + max_speed_m_s * time_s;
}

}  // namespace panvo::vision
