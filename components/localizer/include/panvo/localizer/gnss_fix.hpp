// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace panvo::localizer {

/// Position of the antenna by satellites, in a frame with axes east, north, up: "enu".
struct GnssFix {
  std::int64_t stamp_ns = 0;
  Eigen::Vector3d enu_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  ///< m^2
  Eigen::Vector3d antenna_in_base_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_in_base_m_s = Eigen::Vector3d::Zero();  ///< of the vehicle at the stamp
};

}  // namespace panvo::localizer
