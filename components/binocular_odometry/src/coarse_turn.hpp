// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "panvo/vision/camera.hpp"
#include "panvo/vision/image_pyramid.hpp"

namespace panvo::binocular_odometry {

/// Coarse rotation current_from_previous of a camera between two images, with a resolution of 1/40 of the image width:
/// the shift with the best correlation of the images, downscaled to 40 px, up to 40 % of their size. Used for jerks
/// that break feature tracking; translation is ignored.
Eigen::Matrix3d coarse_turn(const vision::PinholeCamera& camera, const vision::ImagePyramid& previous,
                            const vision::ImagePyramid& current);

}  // namespace panvo::binocular_odometry
