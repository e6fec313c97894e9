// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace panvo::localizer {

/// A turn that the panoramic compass measured [Lu2015 6], and in which direction the vehicle moved meanwhile.
struct AzimuthMeasurement {
  std::int64_t from_ns = 0, to_ns = 0;  ///< stamps of the two panoramas
  double change_rad = 0.0;              ///< left positive
  double variance_rad2 = 0.0;
  double motion_azimuth_rad = 0.0;            ///< of the way, against the axis ahead at its end, left positive
  double motion_azimuth_variance_rad2 = 0.0;  ///< 0: not known
  double side_parallax_rad = 0.0;             ///< how far what is abeam fell behind, median
};

}  // namespace panvo::localizer
