// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "panvo/vision/lens_models/lens_formula.hpp"

/// Projection by a lens model to the normalised image. T: double, or a type that carries derivatives. Directions are in
/// the optical frame (X right, Y down, Z forward) and of any length.
namespace panvo::vision {

template <class T>
struct OffAxis {
  T distance;   ///< from the Z axis, in the unit of the direction
  T angle_rad;  ///< from the Z axis, 0 to pi
};

template <class T>
OffAxis<T> off_axis_of(const Eigen::Matrix<T, 3, 1>& direction) {
  using std::atan2;
  using std::hypot;
  const T distance = hypot(direction.x(), direction.y());
  return {distance, atan2(distance, direction.z())};
}

/// The distortion at a point, whose apply() gives the distorted point and whose jacobian() its derivative.
template <LensFormula Formula, class T>
auto distortion_at(const T* coefficients, const NormalisedPoint<T>& ideal) {
  const T r2 = ideal.x() * ideal.x() + ideal.y() * ideal.y();
  return Formula::distortion(coefficients, r2);
}

/// Point of a direction, after distortion; nullopt outside the model's domain, for example behind a perspective lens.
template <LensFormula Formula, class T>
std::optional<NormalisedPoint<T>> project_direction(const T* coefficients, const Eigen::Matrix<T, 3, 1>& direction,
                                                    const OffAxis<T>& off_axis) {
  constexpr double kNearAxis_rad = 1e-6;
  T scale;  // from the direction to the normalised image
  if (off_axis.distance > T(0.0)) {
    scale = Formula::radius(coefficients, off_axis.angle_rad) / off_axis.distance;
  } else {
    // on the axis, where the distance has no derivative: the limit of the above
    if (!(direction.z() > T(0.0))) return std::nullopt;
    scale = Formula::radius(coefficients, T(kNearAxis_rad)) / (kNearAxis_rad * direction.z());
  }
  if (!(scale >= T(0.0))) return std::nullopt;
  const NormalisedPoint<T> ideal = scale * direction.template head<2>();
  return distortion_at<Formula>(coefficients, ideal).apply(ideal);
}

}  // namespace panvo::vision
