// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

namespace panvo::landmark_builder {

struct PassableRegionParameters {
  double close_m = 1.0;
  double narrowest_m = 2.4;
  double min_hole_m2 = 12.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = PassableRegionParameters;
    field(&P::close_m, "close_m", "m", "width of markings and gaps that are closed", 0.0, 3.0);
    field(&P::narrowest_m, "narrowest_m", "m", "width of the narrowest passable road", 0.1, 10.0);
    field(&P::min_hole_m2, "min_hole_m2", "m^2", "area of the smallest island in the road; smaller ones are filled",
          0.0, 1000.0);
  }
};

/// The part of a road mask (8UC1, 0 or 255) that is connected to `vehicle` and wide enough to drive on, without holes
/// [Lu2015 4.1]. All 0 if the vehicle is not on it.
cv::Mat passable_region(const cv::Mat& road, cv::Point vehicle, double resolution_m,
                        const PassableRegionParameters& parameters);

}  // namespace panvo::landmark_builder
