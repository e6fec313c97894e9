// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/jet.h>

#include <cmath>

#include "panvo/vision/lens.hpp"

namespace panvo::calibration {

/// Number of lens_parameters().
template <vision::LensModel kModel>
constexpr int kLensSize = kModel == vision::LensModel::kRational      ? 12
                          : kModel == vision::LensModel::kEquidistant ? 8
                                                                      : 9;

/// Projects a point in the camera frame to a pixel, as vision::CameraModel::project, for automatic differentiation.
/// Returns false outside the model's domain: behind a perspective lens, or beyond the mirror of kMei.
template <vision::LensModel kModel, typename T>
bool project_point(const T* lens, const T* point, T* pixel) {
  using std::atan2;
  using std::sqrt;
  using vision::LensModel;
  const T off_axis2 = point[0] * point[0] + point[1] * point[1];
  T scale;  // from point to normalised image coordinates
  if constexpr (kModel == LensModel::kEquidistant) {
    if (off_axis2 < T(1e-18)) {
      if (point[2] <= T(0.0)) return false;
      scale = T(1.0) / point[2];
    } else {
      const T off_axis = sqrt(off_axis2);
      scale = atan2(off_axis, point[2]) / off_axis;
    }
  } else {
    T depth = point[2];
    if constexpr (kModel == LensModel::kMei) depth += lens[8] * sqrt(off_axis2 + point[2] * point[2]);
    if (depth <= T(1e-9)) return false;
    scale = T(1.0) / depth;
  }
  const T x = scale * point[0];
  const T y = scale * point[1];
  const T r2 = x * x + y * y;
  const T* d = lens + 4;
  T radial, p1(0.0), p2(0.0);
  if constexpr (kModel == LensModel::kEquidistant) {
    radial = 1.0 + r2 * (d[0] + r2 * (d[1] + r2 * (d[2] + r2 * d[3])));
  } else {
    p1 = d[2];
    p2 = d[3];
    radial = 1.0 + r2 * (d[0] + r2 * d[1]);
    if constexpr (kModel != LensModel::kMei) radial += r2 * r2 * r2 * d[4];
    if constexpr (kModel == LensModel::kRational) radial /= 1.0 + r2 * (d[5] + r2 * (d[6] + r2 * d[7]));
  }
  pixel[0] = lens[0] * (x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x)) + lens[2];
  pixel[1] = lens[1] * (y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y) + lens[3];
  return true;
}

}  // namespace panvo::calibration
