// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace panvo::localizer {

/// A turn measured by the panoramic compass [Lu2015 6], and the direction of motion in that time.
struct AzimuthMeasurement {
  std::int64_t from_ns = 0, to_ns = 0;  ///< stamps of the two panoramas
  double change_rad = 0.0;              ///< left positive, wrapped or not
  double variance_rad2 = 0.0;
  double motion_azimuth_rad = 0.0;            ///< of the motion, relative to the forward axis at its end, left positive
  double motion_azimuth_variance_rad2 = 0.0;  ///< 0: unknown
  double side_parallax_rad = 0.0;             ///< median backward shift of objects abeam
};

}  // namespace panvo::localizer
