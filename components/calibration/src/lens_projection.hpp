// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/jet.h>

#include "panvo/vision/lens_projection.hpp"

namespace panvo::calibration {

inline constexpr double kNotSeen_px = 1e3;  ///< error of a corner that does not project into the image

/// Number of lens_parameters().
template <vision::LensFormula Formula>
constexpr int kLensSize = 4 + static_cast<int>(Formula::kCoefficients.size());

/// Projects a point in the camera frame to a pixel, as vision::CameraModel::project, for automatic differentiation.
/// Returns false outside the model's domain, which is wider than the CameraModel's field of view.
template <vision::LensFormula Formula, typename T>
bool project_point(const T* lens, const T* point, T* pixel) {
  const Eigen::Matrix<T, 3, 1> direction(point[0], point[1], point[2]);
  const auto place = vision::project_direction<Formula>(lens + 4, direction, vision::off_axis_of(direction));
  if (!place) return false;
  pixel[0] = lens[0] * place->x() + lens[2];
  pixel[1] = lens[1] * place->y() + lens[3];
  return true;
}

}  // namespace panvo::calibration
