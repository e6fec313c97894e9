// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "panvo/vision/lens_models/lens_formula.hpp"

namespace panvo::vision {

/// Distortion by a radial factor, a function of the squared radius r2, and by decentring (tangential) terms.
template <class T>
struct RadialTangential {
  T radial;  ///< the factor at r2
  T slope;   ///< derivative of the factor by r2
  T p1 = T(0.0);
  T p2 = T(0.0);

  NormalisedPoint<T> apply(const NormalisedPoint<T>& ideal) const {
    const T& x = ideal.x();
    const T& y = ideal.y();
    const T r2 = x * x + y * y;
    return {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
            y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
  }

  Eigen::Matrix2d jacobian(const NormalisedPoint<T>& ideal) const {
    const double x = ideal.x();
    const double y = ideal.y();
    const double cross = 2.0 * (x * y * slope + p1 * x + p2 * y);
    Eigen::Matrix2d jacobian;
    jacobian << radial + 2.0 * x * x * slope + 2.0 * p1 * y + 6.0 * p2 * x, cross, cross,
        radial + 2.0 * y * y * slope + 6.0 * p1 * y + 2.0 * p2 * x;
    return jacobian;
  }
};

}  // namespace panvo::vision
