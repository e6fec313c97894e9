// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "panvo/vision/lens_models/radial_tangential.hpp"

namespace panvo::vision {

/// Fisheye: the radius is the angle, times a polynomial [Kannala2006, as OpenCV's fisheye].
struct EquidistantLens {
  static constexpr std::string_view kName = "equidistant";
  static constexpr std::array<std::string_view, 1> kAliases{"fisheye"};
  static constexpr std::string_view kPurpose = "fisheye";
  static constexpr std::array<LensCoefficient, 4> kCoefficients{{{"k1"}, {"k2"}, {"k3"}, {"k4"}}};
  static constexpr std::optional<KalibrForm> kKalibr = KalibrForm{"pinhole", "equidistant", 4, 0};
  static constexpr bool kIsPerspective = false;
  static constexpr bool kIsFocalCorrelated = false;

  template <class T>
  static T radius(const T* /*c*/, const T& theta) {
    return theta;
  }

  static double limit_rad(const double* /*c*/) { return std::numbers::pi; }

  static Eigen::Vector3d direction(const double* /*c*/, const NormalisedPoint<double>& ideal) {
    const double r = ideal.norm();
    const double along = r > 0.0 ? std::sin(r) / r : 1.0;
    return {along * ideal.x(), along * ideal.y(), std::cos(r)};
  }

  template <class T>
  static RadialTangential<T> distortion(const T* c, const T& r2) {
    const T radial = 1.0 + r2 * (c[0] + r2 * (c[1] + r2 * (c[2] + r2 * c[3])));
    const T slope = c[0] + r2 * (2.0 * c[1] + r2 * (3.0 * c[2] + r2 * 4.0 * c[3]));
    return {radial, slope};
  }
};

}  // namespace panvo::vision
