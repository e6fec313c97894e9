// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "panvo/vision/lens_models/radial_tangential.hpp"

namespace panvo::vision {

/// Omnidirectional camera: projection onto the unit sphere, then from a point at the distance xi behind its centre, with
/// radial and tangential distortion [Mei2007]. Mirror parameter xi: 0 for a perspective camera, 1 for a parabolic
/// mirror. The focal lengths are Mei's generalised ones.
struct MeiLens {
  static constexpr std::string_view kName = "mei";
  static constexpr std::array<std::string_view, 1> kAliases{"omni-radtan"};
  static constexpr std::string_view kPurpose = "very wide lenses, mirrors";
  static constexpr std::array<LensCoefficient, 5> kCoefficients{
      {{"k1"}, {"k2"}, {"p1"}, {"p2"}, {.name = "xi", .start = 1.0, .min = 0.0, .is_optional = false}}};
  static constexpr std::optional<KalibrForm> kKalibr = KalibrForm{"omni", "radtan", 4, 1};
  static constexpr bool kIsPerspective = false;
  static constexpr bool kIsFocalCorrelated = true;

  template <class T>
  static T radius(const T* c, const T& theta) {
    using std::cos;
    using std::sin;
    return sin(theta) / (cos(theta) + c[4]);
  }

  /// Half a degree below the angle at which the radius is infinite (xi < 1) or largest.
  static double limit_rad(const double* c) {
    const double xi = c[4];
    return std::acos(xi > 1.0 ? -1.0 / xi : -xi) - 0.5 / (180.0 / std::numbers::pi);
  }

  static Eigen::Vector3d direction(const double* c, const NormalisedPoint<double>& ideal) {
    const double xi = c[4];
    const double r = ideal.norm();
    const double lift = (xi + std::sqrt(std::max(0.0, 1.0 + (1.0 - xi * xi) * r * r))) / (r * r + 1.0);
    return {lift * ideal.x(), lift * ideal.y(), lift - xi};
  }

  template <class T>
  static RadialTangential<T> distortion(const T* c, const T& r2) {
    const T radial = 1.0 + r2 * (c[0] + r2 * c[1]);
    const T slope = c[0] + r2 * (2.0 * c[1]);
    return {radial, slope, c[2], c[3]};
  }
};

}  // namespace panvo::vision
