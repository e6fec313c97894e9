// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "panvo/vision/lens_models/lens_formula.hpp"

namespace panvo::vision {

/// What perspective lens models share: without distortion, straight lines stay straight.
struct Perspective {
  static constexpr bool kIsPerspective = true;
  static constexpr bool kIsFocalCorrelated = false;

  template <class T>
  static T radius(const T* /*c*/, const T& theta) {
    using std::tan;
    return tan(theta);
  }

  static double limit_rad(const double* /*c*/) { return 89.0 / (180.0 / std::numbers::pi); }

  static Eigen::Vector3d direction(const double* /*c*/, const NormalisedPoint<double>& ideal) {
    return ideal.homogeneous().normalized();
  }
};

}  // namespace panvo::vision
