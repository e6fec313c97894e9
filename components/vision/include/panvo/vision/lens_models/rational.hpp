// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "panvo/vision/lens_models/plumb_bob.hpp"

namespace panvo::vision {

/// Perspective with a rational radial polynomial and tangential distortion, as cv::projectPoints with eight
/// coefficients.
struct RationalLens : Perspective {
  using Simpler = PlumbBobLens;  ///< the same lens where the further coefficients are zero

  static constexpr std::string_view kName = "rational_polynomial";
  static constexpr std::array<std::string_view, 0> kAliases{};
  static constexpr std::string_view kPurpose = "wide perspective";
  static constexpr std::array<LensCoefficient, 8> kCoefficients{
      {{"k1"}, {"k2"}, {"p1"}, {"p2"}, {"k3"}, {"k4"}, {"k5"}, {"k6"}}};
  static constexpr std::optional<KalibrForm> kKalibr = std::nullopt;

  template <class T>
  static RadialTangential<T> distortion(const T* c, const T& r2) {
    const T above = 1.0 + r2 * (c[0] + r2 * (c[1] + r2 * c[4]));
    const T below = 1.0 + r2 * (c[5] + r2 * (c[6] + r2 * c[7]));
    const T above_slope = c[0] + r2 * (2.0 * c[1] + r2 * 3.0 * c[4]);
    const T below_slope = c[5] + r2 * (2.0 * c[6] + r2 * 3.0 * c[7]);
    const T radial = above / below;
    return {radial, (above_slope - radial * below_slope) / below, c[2], c[3]};
  }
};

}  // namespace panvo::vision
