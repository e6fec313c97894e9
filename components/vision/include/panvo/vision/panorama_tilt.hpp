// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace panvo::vision {

/// How a panoramic camera is mounted on the vehicle.
enum class PanoramaTilt {
  kUpright,    ///< up to 60 degrees
  kOnItsSide,  ///< or the transform has other axes than those of an optical frame (x right, y down, z ahead)
  kHanging     ///< upside down, from 120 degrees
};

inline PanoramaTilt tilt_of_panorama(const Eigen::Matrix3d& base_from_panorama) {
  constexpr double kCosine60 = 0.5;
  const double up = -base_from_panorama(2, 1);  // of the picture's up in the vehicle's axes
  return up > kCosine60 ? PanoramaTilt::kUpright : up < -kCosine60 ? PanoramaTilt::kHanging : PanoramaTilt::kOnItsSide;
}

}  // namespace panvo::vision
