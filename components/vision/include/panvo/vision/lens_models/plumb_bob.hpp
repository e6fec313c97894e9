// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "panvo/vision/lens_models/perspective.hpp"
#include "panvo/vision/lens_models/radial_tangential.hpp"

namespace panvo::vision {

/// Perspective with radial and tangential distortion, as cv::projectPoints with five coefficients.
struct PlumbBobLens : Perspective {
  static constexpr std::string_view kName = "plumb_bob";
  static constexpr std::array<std::string_view, 2> kAliases{"radtan", "radial-tangential"};
  static constexpr std::string_view kPurpose = "perspective";
  static constexpr std::array<LensCoefficient, 5> kCoefficients{{{"k1"}, {"k2"}, {"p1"}, {"p2"}, {"k3"}}};
  static constexpr std::optional<KalibrForm> kKalibr = KalibrForm{"pinhole", "radtan", 4, 0};

  template <class T>
  static RadialTangential<T> distortion(const T* c, const T& r2) {
    const T radial = 1.0 + r2 * (c[0] + r2 * (c[1] + r2 * c[4]));
    const T slope = c[0] + r2 * (2.0 * c[1] + r2 * 3.0 * c[4]);
    return {radial, slope, c[2], c[3]};
  }
};

}  // namespace panvo::vision
