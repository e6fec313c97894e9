// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace panvo::panoramic_compass {

/// Turn of the vehicle between two panoramas, estimated from the panoramas alone.
struct AzimuthChange {
  std::int64_t from_stamp_ns = 0;  ///< of the earlier panorama: the previous one, or a reference kept over several
  std::int64_t stamp_ns = 0;       ///< of the later panorama
  double change_rad = 0.0;  ///< later minus earlier yaw, about the upward axis of the vehicle, left positive, (-pi, pi]
  double variance_rad2 = 0.0;  ///< of change_rad
  /// Mean backward shift of objects beside the vehicle, both sides: about travelled distance / object distance;
  /// negative when driving backwards [Lu2015 6]. If few are there: at least half of what the nearer of all moved.
  double side_parallax_rad = 0.0;
  double motion_azimuth_rad =
      0.0;  ///< direction of motion relative to the current forward axis, left positive, [-pi, pi]
  double motion_azimuth_variance_rad2 = 0.0;  ///< of motion_azimuth_rad; 0: unknown
  bool valid = false;
  std::string reason{};  ///< why not valid; empty if valid
};

}  // namespace panvo::panoramic_compass
