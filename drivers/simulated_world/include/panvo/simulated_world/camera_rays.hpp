// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "panvo/vision/lens.hpp"

namespace panvo::simulated_world {

/// The viewing ray of each pixel of a camera. The renderer treats every camera as such a table.
struct CameraRays {
  int width = 0, height = 0;  ///< px
  std::vector<Eigen::Vector3f>
      directions;  ///< row by row: unit, optical frame (x right, y down, z forward); zero: sees nothing
  /// The ray through any image position, for samples within a pixel; (0, 0) is the centre of the first pixel.
  /// Bilinear between the table's entries: exact to 1e-3 px for the cameras below.
  Eigen::Vector3f direction(float column, float row) const;
  bool wraps = false;  ///< the last column adjoins the first one: a panorama
};

/// Pinhole with radial-tangential distortion (plumb_bob). Throws std::invalid_argument for another lens model, a focal
/// length that is not positive, a field of view of 180 degrees or more, or a distortion that folds the image over.
CameraRays pinhole_rays(const vision::LensCamera& camera);

/// Equirectangular panorama [Lu2015 Eqs. 9, 10]: pixel (u, v) looks at azimuth 2 pi u / width - pi (clockwise from
/// straight ahead) and elevation pi v / height - pi / 2 (downwards).
CameraRays panorama_rays(int width, int height);

/// Equidistant fisheye with Kannala-Brandt coefficients, OpenCV's "fisheye": r = f (t + k1 t^3 + k2 t^5 + k3 t^7 + k4
/// t^9), for angles t up to half of `field_of_view_rad` (at most 2 pi).
struct FisheyeCamera {
  vision::PinholeCamera pinhole;
  std::array<double, 4> distortion{};
  double field_of_view_rad = 3.3;
};
CameraRays fisheye_rays(const FisheyeCamera& camera);

}  // namespace panvo::simulated_world
