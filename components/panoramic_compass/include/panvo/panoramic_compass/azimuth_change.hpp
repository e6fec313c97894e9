// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace panvo::panoramic_compass {

/// By how much the vehicle turned between two panoramas, as the panoramas alone show it.
struct AzimuthChange {
  std::int64_t from_stamp_ns = 0;  ///< of the earlier panorama: the last one, or the reference kept over several
  std::int64_t stamp_ns = 0;       ///< of the later one
  double change_rad = 0.0;     ///< yaw now minus yaw then, about the vehicle's upward axis, left positive, (-pi, pi]
  double variance_rad2 = 0.0;  ///< of change_rad
  /// How far what is beside the vehicle fell behind, mean of both sides: about way / distance of what is there; backwards
  /// negative [Lu2015 6].
  double side_parallax_rad = 0.0;
  double motion_azimuth_rad =
      0.0;  ///< where the vehicle moved to, against its axis ahead now, left positive, [-pi, pi]
  double motion_azimuth_variance_rad2 = 0.0;  ///< of motion_azimuth_rad; 0: not known
  bool valid = false;
  std::string reason{};  ///< why not valid; empty when it is
};

}  // namespace panvo::panoramic_compass
